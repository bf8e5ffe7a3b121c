/* region.js - the drawing of a region, and what its integrals mean in it: centroid and axes, the
 * ellipse that has the same area's second moments, the mean distance as a circle, and how far the
 * filters reach. */
'use strict';

const TOLERANCE = 2 ** -14;       /* from a curve to its chords, in units */
const SUPPORTS = [1, 2, 4];       /* of box, tent and Mitchell's filter, in pixels */

/* Semi-axes and direction of the uniform ellipse whose second moments, divided by its area, are
 * those of the region; nothing if there is no such ellipse. */
function momentEllipse({ area, m20, m11, m02 }) {
	const middle = (m20 + m02) / 2 / area, half = Math.hypot((m20 - m02) / 2, m11) / Math.abs(area);
	if (!(middle - half > 0))
		return null;
	const sign = Math.sign(area);
	return { a: 2 * Math.sqrt(middle + half), b: 2 * Math.sqrt(middle - half),
		angle: Math.atan2(2 * m11 * sign, (m20 - m02) * sign) / 2 };
}

class RegionFigure {
	constructor(element, size, actions) {
		this.figure = new Figure(element, ...size, actions);
		const { drawing } = this.figure.layers;
		this.parts = {};
		for (const [part, name] of Object.entries({ fill: 'path', triangle: 'path', reach: 'path',
			mean: 'circle', ray: 'path', ellipse: 'ellipse', axes: 'path', levers: 'path',
			outline: 'path' }))
			this.parts[part] = svg(drawing, name, { class: part });
	}

	set(part, attributes) {
		set(this.parts[part], attributes);
	}

	/* Where there is no number there is no drawing. */
	hide(part, hidden) {
		this.parts[part].toggleAttribute('hidden', hidden);
	}

	draw({ shape, centre, filterAt, scale }, result) {
		const { figure } = this, outline = this.outline(shape);
		this.set('fill', { d: outline });
		this.set('outline', { d: outline });
		this.set('levers', { d: this.levers(shape) });
		this.drawTriangle(shape, result);
		this.drawEllipse(result);
		this.drawDistance(centre, result);
		this.set('reach', { d: SUPPORTS.map(width => this.square(filterAt, width / scale)).join('') });
		figure.show([...this.points(shape), { key: 'centre', point: centre, kind: 'centre',
			mark: 'target', label: 'Centre of the distance' }, { key: 'filter', point: filterAt,
			kind: 'filter', mark: 'cross', label: 'Centre of the filter' }]);
	}

	*points(shape) {
		const many = shape.contours.length > 1;
		for (const { key, point, contour, node, control } of shape.points()) {
			const name = `${node + 1}${many ? ` of contour ${contour + 1}` : ''}`;
			if (control === undefined)
				yield { key, point, kind: 'node', mark: 'node', label: `Vertex ${name}` };
			else
				yield { key, point, kind: 'control', mark: 'control',
					label: `Control ${control + 1} of edge ${name}` };
		}
	}

	outline(shape) {
		let path = '';
		for (const { node, points, weight } of shape.edges()) {
			if (node === 0)
				path += `${path ? 'Z' : ''}M${this.figure.to(points[0])}`;
			path += this.piece(points, weight);
		}
		return path + 'Z';
	}

	/* One edge as SVG draws it; a conic, which SVG does not know, by 32 lines. */
	piece(points, weight) {
		const { figure } = this;
		if (weight === undefined)
			return 'LQC'[points.length - 2] +
				points.slice(1).map(point => figure.to(point)).join(' ');
		let path = '';
		for (let i = 1; i <= 32; i++)
			path += `L${figure.to(Shape.at(points, weight, i / 32))}`;
		return path;
	}

	/* From each control to the node that it bends the edge at. */
	levers(shape) {
		const { figure } = this;
		let path = '';
		for (const { points } of shape.edges()) {
			if (points.length === 3)
				path += `M${points.map(point => figure.to(point)).join('L')}`;
			else if (points.length === 4)
				path += `M${figure.to(points[0])}L${figure.to(points[1])}` +
					`M${figure.to(points[2])}L${figure.to(points[3])}`;
		}
		return path;
	}

	/* contour, node, control of the chosen point; its edge leaves the node, or has it for a control. */
	get chosen() {
		const numbers = (this.figure.chosen ?? '').split('.').map(Number);
		return Number.isInteger(numbers[1]) ? numbers : null;
	}

	/* What the chosen edge adds to the area. */
	drawTriangle(shape, { terms, edge }) {
		this.hide('triangle', edge < 0);
		if (edge < 0)
			return;
		const [contour, node] = this.chosen, { figure } = this;
		const outline = this.piece(shape.edge(contour, node), shape.contours[contour][node].weight);
		this.set('triangle', { d: `M${figure.to([0, 0])}L${figure.to(shape.edge(contour, node)[0])}` +
			`${outline}Z`, class: terms[edge] < 0 ? 'triangle negative' : 'triangle' });
	}

	square([x, y], width) {
		const { figure } = this, side = width * figure.unit;
		return `M${figure.to([x - width / 2, y + width / 2])}h${side}v${side}h${-side}Z`;
	}

	drawEllipse(result) {
		const { figure } = this, { cx, cy } = result, ellipse = momentEllipse(result);
		this.hide('ellipse', !ellipse);
		this.hide('axes', !ellipse);
		if (!ellipse)
			return;
		const a = ellipse.a * figure.unit, b = ellipse.b * figure.unit;
		const transform = `translate(${figure.to([cx, cy])}) ` +
			`rotate(${(-ellipse.angle * 180 / Math.PI).toFixed(3)})`;
		this.set('ellipse', { rx: a, ry: b, transform });
		this.set('axes', { d: `M${-a} 0H${a}M0${-b}V${b}`, transform });
	}

	drawDistance(centre, { cx, cy, mean }) {
		const { figure } = this, none = !(mean >= 0);
		this.hide('mean', none);
		this.hide('ray', none);
		if (none)
			return;
		this.set('mean', { cx: figure.x(centre[0]), cy: figure.y(centre[1]),
			r: mean * figure.unit });
		this.set('ray', { d: `M${figure.to(centre)}L${figure.to([cx, cy])}` });
	}
}

/* Semi-axes, and the direction of the longer one if there is one. */
function ellipseText(ellipse) {
	if (!ellipse)
		return 'none: not definite';
	const a = say(ellipse.a, 3), b = say(ellipse.b, 3);
	return `${a} × ${b}` + (a === b ? '' : `, ${say(ellipse.angle * 180 / Math.PI, 1)}°`);
}

/* The numbers beside the drawing. */
function regionTexts({ centre, filterAt, scale, shape }, result) {
	const pair = ([x, y]) => `(${say(x)}, ${say(y)})`;
	const bounded = Number.isFinite(result.bound), lines = result.lines.toLocaleString('en');
	return {
		area: say(result.area, 10),
		bound: bounded ? result.bound.toExponential(1) : '–',
		centroid: `(${say(result.cx, 6)}, ${say(result.cy, 6)})`,
		m20: say(result.m20, 6),
		m11: say(result.m11, 6),
		m02: say(result.m02, 6),
		ellipse: ellipseText(momentEllipse(result)),
		exactness: bounded ? 'From the vertices: ew_central_moments, ew_moments_bounded.' :
			'From lines and curves as they are, no flattening: ew_path_moments.',
		centre: pair(centre),
		distance: say(result.distance, 6),
		mean: say(result.mean, 6),
		filterAt: pair(filterAt),
		box: say(result.box, 6),
		tent: say(result.tent, 6),
		mitchell: say(result.mitchell, 6),
		chords: shape.curved ? `Distance and filters know lines only: from ${lines} chords, within ` +
			`${say(TOLERANCE, 5)} of the curves.` :
			`From the ${lines} edges: ew_distance, ew_tent, ew_mitchell.`,
		term: result.edge < 0 ? '' : `The chosen edge adds ${say(result.terms[result.edge], 4)}.`,
		zoom: say(scale),
	};
}
