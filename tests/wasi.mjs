// wasi.mjs - runs a WebAssembly program that writes to standard output: node tests/wasi.mjs PROGRAM
import { readFile } from 'node:fs/promises';
import { WASI } from 'node:wasi';

const wasi = new WASI({ version: 'preview1', args: [process.argv[2]] });
const program = await WebAssembly.compile(await readFile(process.argv[2]));
process.exitCode = wasi.start(
	await WebAssembly.instantiate(program, { wasi_snapshot_preview1: wasi.wasiImport }));
