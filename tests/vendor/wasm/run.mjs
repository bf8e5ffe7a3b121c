import { readFileSync } from "node:fs";

const { instance } = await WebAssembly.instantiate(readFileSync("edgewise.wasm"));
const { memory, malloc, ew_area, ew_targets, ew_target_name } = instance.exports;
instance.exports._initialize();

function doubles(...values) {
	const address = malloc(8 * values.length);
	new Float64Array(memory.buffer, address, values.length).set(values);
	return address;
}

function text(address) {
	const bytes = new Uint8Array(memory.buffer, address);
	return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}

const area = ew_area(doubles(0, 4, 4, 0), doubles(0, 0, 3, 3), 4);
const best = 2 ** (31 - Math.clz32(ew_targets()));
console.log(`area ${area} by ${text(ew_target_name(best))}`);
