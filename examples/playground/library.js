/* library.js - the emitted kernels, called from script.
 *
 * Paths and results lie in buffers of playground.c. A view of the memory is made for each use:
 * memory that has grown leaves older views empty. */
'use strict';

const VERB = { move: 0, line: 1, quad: 2, conic: 3, cubic: 4, close: 5 };
const FILTERS = ['box', 'tent', 'mitchell'];

class Library {
	/* From a module in WebAssembly, compressed by gzip, in base64. */
	static async load(base64) {
		const packed = new Blob([Uint8Array.from(atob(base64), c => c.charCodeAt(0))]);
		const stream = packed.stream().pipeThrough(new DecompressionStream('gzip'));
		const bytes = await new Response(stream).arrayBuffer();
		return new Library((await WebAssembly.instantiate(bytes)).instance.exports);
	}

	constructor(kernels) {
		this.kernels = kernels;
	}

	array(Type, name, length) {
		return new Type(this.kernels.memory.buffer, this.kernels[name].value, length);
	}

	get target() {
		const bytes = new Uint8Array(this.kernels.memory.buffer, this.kernels.target());
		return String.fromCharCode(...bytes.subarray(0, bytes.indexOf(0)));
	}

	/* The region inside a path: what is asked from here on is about it. Curves become chords, where
	 * they must, that are no farther than `tolerance` away. */
	region({ verbs, points, weights }, tolerance) {
		this.array(Uint8Array, 'verbs', verbs.length).set(verbs);
		this.array(Float64Array, 'points', points.length).set(points);
		this.array(Float64Array, 'weights', weights.length).set(weights);
		const status = this.kernels.region(verbs.length, points.length / 2, weights.length,
			tolerance);
		const [area] = this.array(Float64Array, 'moments', 1);
		const [bound] = this.array(Float64Array, 'bounds', 1);
		const [cx, cy] = this.array(Float64Array, 'centroid', 2);
		const [, , , m20, m11, m02] = this.array(Float64Array, 'central', 6);
		return { status, area, bound, cx, cy, m20, m11, m02, lines: this.kernels.lines() };
	}

	/* What one edge adds to the area. */
	term(points, weight) {
		const coordinates = points.flat();
		if (weight !== undefined)
			return this.kernels.ew_conic_area(...coordinates, weight);
		return this.kernels[`ew_${['line', 'quad', 'cubic'][points.length - 2]}_area`](...coordinates);
	}

	distance([x, y]) {
		return this.kernels.distance(x, y);
	}

	filter(scale, [x, y]) {
		this.kernels.filter(scale, x, y);
		const [box, tent, mitchell] = this.array(Float64Array, 'filtered', 3);
		return { box, tent, mitchell };
	}

	/* RGBA, a pixel an element, the top row first; `from` is the lower left corner. */
	picture(filter, scale, [x, y], [width, height]) {
		const status = this.kernels.picture(FILTERS.indexOf(filter), scale, x, y, width, height);
		if (status !== 0)
			throw new Error(`no picture: ${status}`);
		return this.array(Uint8ClampedArray, 'shades', 4 * width * height);
	}

	set palette(colours) {
		this.array(Uint32Array, 'palette', colours.length).set(colours);
	}

	below([px, py], [qx, qy], { u0, u1, v0, v1 }) {
		return this.kernels.ew_below(px, py, qx, qy, u0, u1, v0, v1);
	}

	coverage([px, py], [qx, qy], { u0, u1, v0, v1 }) {
		return this.kernels.ew_line_coverage(px, py, qx, qy, u0, u1, v0, v1);
	}
}
