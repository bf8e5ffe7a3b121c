/* below.js - the area below a line segment in a rectangle, with everything of it movable. */
'use strict';

class BelowFigure {
	constructor(element, size, changed) {
		this.p = [1.5, 1.25];
		this.q = [13.5, 7.75];
		this.lower = [3.5, 3.25];
		this.upper = [12, 6.25];
		this.figure = new Figure(element, ...size, { moved: (key, at) => {
			this.move(key, at);
			changed(key);
		}, redraw: changed });
		const { drawing } = this.figure.layers;
		this.parts = Object.fromEntries(['sides', 'rectangle', 'area', 'segment'].map(part =>
			[part, svg(drawing, 'path', { class: part })]));
		this.names = ['p', 'q', 'u₀, v₀', 'u₁, v₁'].map(name => {
			const text = svg(drawing, 'text');
			text.append(name);
			return text;
		});
	}

	/* However the corners lie. */
	get rectangle() {
		const [x0, y0] = this.lower, [x1, y1] = this.upper;
		return { u0: Math.min(x0, x1), u1: Math.max(x0, x1), v0: Math.min(y0, y1),
			v1: Math.max(y0, y1) };
	}

	get middle() {
		return between(this.lower, this.upper, 0.5);
	}

	move(key, at) {
		if (key !== 'middle') {
			this[key] = at;
			return;
		}
		const { width, height } = this.figure, { u0, u1, v0, v1 } = this.rectangle;
		const [x, y] = this.middle;
		const dx = Math.min(Math.max(at[0] - x, -u0), width - u1);
		const dy = Math.min(Math.max(at[1] - y, -v0), height - v1);
		for (const corner of ['lower', 'upper'])
			this[corner] = [onGrid(this[corner][0] + dx), onGrid(this[corner][1] + dy)];
	}

	/* The outline of what is measured, for the eye: the segment between u0 and u1, held between v0
	 * and v1, and the rectangle's lower side. */
	shade() {
		const { u0, u1, v0, v1 } = this.rectangle;
		const [p, q] = this.p[0] <= this.q[0] ? [this.p, this.q] : [this.q, this.p];
		const from = Math.max(p[0], u0), to = Math.min(q[0], u1);
		if (!(from < to))
			return '';
		const slope = (q[1] - p[1]) / (q[0] - p[0]);
		const crossings = [v0, v1].map(v => p[0] + (v - p[1]) / slope).filter(x =>
			x > from && x < to);
		const top = [from, ...crossings.sort((a, b) => a - b), to].map(x =>
			[x, Math.min(Math.max(p[1] + slope * (x - p[0]), v0), v1)]);
		return `M${[[from, v0], ...top, [to, v0]].map(point => this.figure.to(point)).join('L')}Z`;
	}

	draw(library) {
		const { figure, parts, p, q, rectangle: r } = this;
		const corners = [[r.u0, r.v0], [r.u1, r.v1]];
		set(parts.area, { d: this.shade() });
		set(parts.segment, { d: `M${figure.to(p)}L${figure.to(q)}` });
		set(parts.rectangle, { d: `M${figure.to(corners[0])}H${figure.x(r.u1)}V${figure.y(r.v1)}` +
			`H${figure.x(r.u0)}Z` });
		set(parts.sides, { d: [r.u0, r.u1].map(u => `M${figure.x(u)} 0V${figure.y(0)}`).join('') });
		for (const [i, [x, y]] of [p, q, ...corners].entries())
			set(this.names[i], { x: figure.x(x) + (i === 3 ? -10 : 10),
				y: figure.y(y) + (i === 2 ? 22 : -12), 'text-anchor': i === 3 ? 'end' : 'start' });
		figure.show([
			{ key: 'p', point: p, kind: 'node', mark: 'node', label: 'End p of the segment' },
			{ key: 'q', point: q, kind: 'node', mark: 'node', label: 'End q of the segment' },
			{ key: 'lower', point: this.lower, kind: 'corner', mark: 'corner',
				label: 'Corner of the rectangle' },
			{ key: 'upper', point: this.upper, kind: 'corner', mark: 'corner',
				label: 'Opposite corner of the rectangle' },
			{ key: 'middle', point: this.middle, kind: 'corner', mark: 'cross',
				label: 'The rectangle, by its middle' },
		]);
		return this.measure(library, r);
	}

	/* The top side of the rectangle has all of it below. */
	measure(library, r) {
		return { below: library.below(this.p, this.q, r), coverage: library.coverage(this.p, this.q, r),
			whole: library.below([r.u0, r.v1], [r.u1, r.v1], r) };
	}

	texts({ below, whole, coverage }) {
		const { u0, u1, v0, v1 } = this.rectangle, list = (a, b) => `${say(a)}, ${say(b)}`;
		return { below: say(below, 10), share: `${say(100 * below / whole, 2)} %`,
			coverage: say(coverage, 10), p: list(...this.p), q: list(...this.q),
			u: list(u0, u1), v: list(v0, v1) };
	}
}
