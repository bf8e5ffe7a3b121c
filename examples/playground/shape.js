/* shape.js - a region: contours of nodes, and what can be done to them.
 *
 * A node is { at, controls, weight }: a point, and the edge that leaves it for the next node of its
 * contour. No control makes it a line, one a quadratic or, if it has a weight, a conic, two a
 * cubic. Points are [x, y], y upwards. */
'use strict';

/* Where things stand at the beginning. Paths are absolute ones as in SVG; K is a conic: control, end,
 * weight. */
const PRESETS = {
	Polygon: {
		path: 'M2.5 2 L9 1.25 L13.5 3.5 L10.75 6 L13 9.75 L7 10.5 L5.25 6.5 L1.75 7.5 Z',
		centre: [5.25, 4.5], filter: [11.6, 2.45],
	},
	Star: {
		path: 'M8 11.25 L4.75 1.5 L13.25 7.5 L2.75 7.5 L11.25 1.5 Z',
		centre: [6, 6], filter: [9.75, 6],
	},
	Letter: {
		path: 'M12.5 5.3 C12.6 8.5 10.9 10.75 8 10.75 C5.2 10.75 3.3 8.7 3.3 5.95 ' +
			'C3.3 3 5.25 1.2 8.3 1.2 C9.9 1.2 11.2 1.7 12.1 2.6 L11.3 3.9 ' +
			'C10.6 3.3 9.7 2.9 8.7 2.9 C6.8 2.9 5.5 3.8 5.3 5.3 Z ' +
			'M5.35 6.7 C5.6 8.25 6.6 9.2 8 9.2 C9.4 9.2 10.4 8.2 10.55 6.7 Z',
		centre: [7.25, 4.75], filter: [12.4, 5.4],
	},
	Circle: {
		path: `M12 6 K12 10 8 10 ${Math.SQRT1_2} K4 10 4 6 ${Math.SQRT1_2} ` +
			`K4 2 8 2 ${Math.SQRT1_2} K12 2 12 6 ${Math.SQRT1_2} Z`,
		centre: [6, 5], filter: [10.75, 8.75],
	},
};

const MOST = 1000;    /* points: what there is room for, and more than anyone can tell apart */
const onGrid = v => Math.round(v * 100) / 100;
const between = ([ax, ay], [bx, by], t) => [ax + (bx - ax) * t, ay + (by - ay) * t];
const apart = ([ax, ay], [bx, by]) => Math.hypot(bx - ax, by - ay);

class Shape {
	constructor(path) {
		this.contours = [];
		for (const [, command, list] of path.matchAll(/([MLQCKZ])([^MLQCKZ]*)/g)) {
			const numbers = (list.match(/[^\s,]+/g) ?? []).map(Number);
			const weight = command === 'K' ? numbers.pop() : undefined;
			const points = [];
			for (let i = 0; i < numbers.length; i += 2)
				points.push(numbers.slice(i, i + 2));
			if (command === 'M')
				this.contours.push([{ at: points[0], controls: [] }]);
			else if (command !== 'Z')
				this.draw(points, weight);
		}
		for (const contour of this.contours)
			Shape.close(contour);
	}

	/* An edge from the last node so far. */
	draw(points, weight) {
		const contour = this.contours[this.contours.length - 1];
		const last = contour[contour.length - 1];
		const at = points.pop();
		last.controls = points;
		last.weight = weight;
		contour.push({ at, controls: [] });
	}

	/* The edge of the last node leads to the first: one that has come back already is not needed. */
	static close(contour) {
		if (contour.length > 1 && apart(contour[0].at, contour[contour.length - 1].at) === 0)
			contour.pop();
	}

	/* { key, point, contour, node, control }, of every point; control is absent for nodes. */
	*points() {
		for (const [c, contour] of this.contours.entries()) {
			for (const [n, node] of contour.entries()) {
				yield { key: `${c}.${n}`, point: node.at, contour: c, node: n };
				for (const [i, point] of node.controls.entries())
					yield { key: `${c}.${n}.${i}`, point, contour: c, node: n, control: i };
			}
		}
	}

	/* The edge that leaves a node: all its points. */
	edge(c, n) {
		const contour = this.contours[c], node = contour[n];
		return [node.at, ...node.controls, contour[(n + 1) % contour.length].at];
	}

	*edges() {
		for (const [c, contour] of this.contours.entries())
			for (const n of contour.keys())
				yield { contour: c, node: n, points: this.edge(c, n),
					weight: contour[n].weight };
	}

	/* As the library takes it. */
	path() {
		const verbs = [], points = [], weights = [];
		for (const { contour, node, points: edge, weight } of this.edges()) {
			if (node === 0) {
				verbs.push(VERB.move);
				points.push(...edge[0]);
			}
			if (weight !== undefined)
				weights.push(weight);
			const last = node === this.contours[contour].length - 1;
			if (edge.length > 2 || !last) {
				verbs.push(weight !== undefined ? VERB.conic :
					[VERB.line, VERB.quad, VERB.cubic][edge.length - 2]);
				points.push(...edge.slice(1).flat());
			}
			if (last)
				verbs.push(VERB.close);
		}
		return { verbs, points, weights };
	}

	/* Whether any edge is not a line. */
	get curved() {
		return this.contours.some(contour => contour.some(node => node.controls.length > 0));
	}

	/* A node takes along the controls that are drawn to it: both its edges keep their directions. */
	move(key, to) {
		const [c, n, control] = key.split('.').map(Number), contour = this.contours[c];
		const node = contour[n];
		if (control !== undefined) {
			node.controls[control] = to;
			return;
		}
		const by = [to[0] - node.at[0], to[1] - node.at[1]];
		const shift = ([x, y]) => [onGrid(x + by[0]), onGrid(y + by[1])];
		const before = contour[(n + contour.length - 1) % contour.length];
		if (node.controls.length === 2)
			node.controls[0] = shift(node.controls[0]);
		if (before.controls.length === 2)
			before.controls[1] = shift(before.controls[1]);
		node.at = to;
	}

	/* ---- edits: each returns the key of the point that is chosen then ---- */

	/* A new node at t of the edge that leaves node n: de Casteljau's construction, of a conic in
	 * homogeneous coordinates at 1/2. Lines are split to the grid that points are moved on. */
	split(c, n, t = 0.5) {
		const contour = this.contours[c], node = contour[n], edge = this.edge(c, n);
		if ([...this.points()].length > MOST)
			return `${c}.${n}`;
		let at, left, right, weight;
		if (node.weight !== undefined) {
			const w = node.weight, [p0, p1, p2] = edge;
			left = [between(p0, p1, w / (1 + w))];
			right = [between(p2, p1, w / (1 + w))];
			at = between(left[0], right[0], 0.5);
			weight = Math.sqrt((1 + w) / 2);
		} else if (edge.length === 2) {
			at = between(...edge, t).map(onGrid);
			left = [];
			right = [];
		} else {
			let row = edge;
			left = [];
			right = [];
			while (row.length > 1) {
				row = row.slice(1).map((point, i) => between(row[i], point, t));
				left.push(row[0]);
				right.unshift(row[row.length - 1]);
			}
			at = left.pop();
			right.shift();
		}
		node.controls = left;
		node.weight = weight;
		contour.splice(n + 1, 0, { at, controls: right, weight });
		return `${c}.${n + 1}`;
	}

	/* Without a control the edge is of a lower degree. Without a node the edges on its sides become
	 * one: a line if both are, else a cubic that leaves and arrives as they did. */
	remove(c, n, control) {
		const contour = this.contours[c], node = contour[n];
		if (control !== undefined) {
			node.controls.splice(control, 1);
			node.weight = undefined;
			return `${c}.${n}`;
		}
		const before = (n + contour.length - 1) % contour.length;
		if (contour.length <= 2) {
			if (this.contours.length === 1)
				return `${c}.${n}`;
			this.contours.splice(c, 1);
			return '0.0';
		}
		const into = this.edge(c, before), from = this.edge(c, n);
		const straight = into.length === 2 && from.length === 2;
		const first = into.length > 2 ? into[1] : between(into[0], from[from.length - 1], 1 / 3);
		const second = from.length > 2 ? from[from.length - 2] :
			between(into[0], from[from.length - 1], 2 / 3);
		contour[before].controls = straight ? [] : [first, second];
		contour[before].weight = undefined;
		contour.splice(n, 1);
		return `${c}.${before > n ? before - 1 : before}`;
	}

	/* A line becomes a cubic with a little bulge, anything else a line. */
	bend(c, n) {
		const node = this.contours[c][n], [a, b] = [this.edge(c, n)[0], this.edge(c, n).pop()];
		const out = [(b[1] - a[1]) / 5, (a[0] - b[0]) / 5];
		const beside = t => between(a, b, t).map((v, i) => onGrid(v + out[i]));
		node.controls = node.controls.length > 0 ? [] : [beside(1 / 3), beside(2 / 3)];
		node.weight = undefined;
		return `${c}.${n}`;
	}

	/* ---- where things are ---- */

	/* The edge nearest to a point, among samples of it. */
	nearest(point) {
		let best = { distance: Infinity };
		for (const { contour, node, points, weight } of this.edges()) {
			for (let i = 0; i <= 64; i++) {
				const t = i / 64, distance = apart(point, Shape.at(points, weight, t));
				if (distance < best.distance)
					best = { distance, contour, node, t };
			}
		}
		return best;
	}

	/* The point at t of an edge. */
	static at(points, weight, t) {
		if (weight !== undefined) {
			const b = [(1 - t) * (1 - t), 2 * weight * t * (1 - t), t * t];
			const sum = b[0] + b[1] + b[2];
			return [0, 1].map(i => (b[0] * points[0][i] + b[1] * points[1][i] +
				b[2] * points[2][i]) / sum);
		}
		let row = points;
		while (row.length > 1)
			row = row.slice(1).map((point, i) => between(row[i], point, t));
		return row[0];
	}
}
