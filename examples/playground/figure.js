/* figure.js - a drawing in SVG with points that can be moved, by mouse, finger, pen and keys.
 *
 * Coordinates are those of a page of paper, `width` x `height` units, y upwards; the drawing fills
 * the width it has. A press takes the nearest point within reach, so that what a finger must meet
 * is much larger than what is drawn; where no point is near, a finger scrolls the page. */
'use strict';

const REACH = { mouse: 20, touch: 44, pen: 44 };    /* in CSS pixels, from the point */
const STEP = 0.1, FINE = 0.01, COARSE = 1;
/* What stands for a point, by its kind, in CSS pixels. */
const MARKS = {
	node: 'M-6 0a6 6 0 1 0 12 0a6 6 0 1 0-12 0Z',
	control: 'M0-6L6 0L0 6L-6 0Z',
	corner: 'M-5-5H5V5H-5Z',
	target: 'M-7 0a7 7 0 1 0 14 0a7 7 0 1 0-14 0ZM0-11V-4M0 4V11M-11 0H-4M4 0H11',
	cross: 'M-6-6H6V6H-6ZM0-10V-3M0 3V10M-10 0H-3M3 0H10',
};
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/* Only what differs: style and layout follow each attribute that is set. */
function set(element, attributes) {
	for (const [name, value] of Object.entries(attributes))
		if (element.getAttribute(name) !== String(value))
			element.setAttribute(name, value);
}

function svg(parent, name, attributes = {}) {
	const element = document.createElementNS('http://www.w3.org/2000/svg', name);
	set(element, attributes);
	parent.append(element);
	return element;
}

class Figure {
	/* moved(key, [x, y]) is told where a point should go; keyed(key, event) sees other keys; redraw()
	 * is called when the size or the chosen point is another. */
	constructor(element, width, height, { moved, keyed = () => false, redraw }) {
		Object.assign(this, { element, width, height, moved, keyed, redraw });
		this.layers = Object.fromEntries(['grid', 'drawing', 'handles'].map(name =>
			[name, svg(element, 'g', { class: name })]));
		this.handles = new Map();
		this.chosen = null;
		element.addEventListener('pointerdown', event => this.press(event));
		element.addEventListener('pointermove', event => this.drag(event));
		for (const end of ['pointerup', 'pointercancel'])
			element.addEventListener(end, event => this.release(event));
		element.addEventListener('touchstart', event => {
			const { clientX, clientY } = event.changedTouches[0];
			if (this.near(clientX, clientY, REACH.touch) !== null)
				event.preventDefault();
		}, { passive: false });
		element.addEventListener('keydown', event => this.pressKey(event));
		new ResizeObserver(() => {
			this.fit();
			redraw();
		}).observe(element);
		this.fit();
	}

	/* The size on the screen, in CSS pixels, and the paper's lines. */
	fit() {
		const wide = this.element.clientWidth || this.width;
		this.unit = wide / this.width;
		const high = this.height * this.unit;
		set(this.element, { viewBox: `0 0 ${wide} ${high}` });
		let path = '';
		for (let x = 1; x < this.width; x++)
			path += `M${x * this.unit} 0V${high}`;
		for (let y = 1; y < this.height; y++)
			path += `M0 ${y * this.unit}H${wide}`;
		this.layers.grid.replaceChildren();
		svg(this.layers.grid, 'path', { d: path });
	}

	x(x) {
		return x * this.unit;
	}

	y(y) {
		return (this.height - y) * this.unit;
	}

	to([x, y]) {
		return `${this.x(x).toFixed(2)} ${this.y(y).toFixed(2)}`;
	}

	/* { key, point, kind, mark, label }, of every point that can be moved. Keys may name other points
	 * when their number has changed: who holds one then lets go. */
	show(points) {
		const keys = new Set(points.map(point => point.key));
		if (keys.size !== this.handles.size)
			this.letGo();
		for (const [key, handle] of this.handles) {
			if (!keys.has(key)) {
				handle.element.remove();
				this.handles.delete(key);
			}
		}
		for (const { key, point, kind, mark, label } of points) {
			const handle = this.handles.get(key) ?? this.add(key, kind, mark);
			const [x, y] = point;
			handle.point = point;
			set(handle.element, { transform: `translate(${this.to(point)})`, 'aria-label': label,
				'aria-valuenow': x, 'aria-valuetext': `x ${say(x)}, y ${say(y)}` });
		}
		/* Tab goes from point to point as they are listed. */
		let place = this.layers.handles.firstChild;
		for (const { key } of points) {
			const { element } = this.handles.get(key);
			if (element === place)
				place = place.nextSibling;
			else
				this.layers.handles.insertBefore(element, place);
		}
	}

	/* What can be moved in two directions is a slider whose value is said in words. */
	add(key, kind, mark) {
		const element = svg(this.layers.handles, 'g', { class: `handle ${kind}`, tabindex: 0,
			role: 'slider', 'aria-roledescription': 'movable point', 'aria-valuemin': 0,
			'aria-valuemax': this.width });
		svg(element, 'circle', { class: 'halo', r: 14 });
		svg(element, 'path', { class: 'mark', d: MARKS[mark] });
		element.addEventListener('focus', () => {
			this.choose(key);
			this.redraw();
		});
		const handle = { element };
		this.handles.set(key, handle);
		return handle;
	}

	choose(key) {
		this.handles.get(this.chosen)?.element.removeAttribute('data-chosen');
		this.chosen = key;
		this.handles.get(key)?.element.setAttribute('data-chosen', '');
	}

	focus(key) {
		this.handles.get(key)?.element.focus({ preventScroll: true });
	}

	paper(clientX, clientY) {
		const box = this.element.getBoundingClientRect();
		return [(clientX - box.left) / this.unit, this.height - (clientY - box.top) / this.unit];
	}

	/* The key of the nearest point within reach; those that are drawn later are on top. */
	near(clientX, clientY, reach) {
		const at = this.paper(clientX, clientY);
		let best = null, least = reach / this.unit;
		for (const [key, { point }] of this.handles) {
			const distance = apart(at, point);
			if (distance <= least) {
				best = key;
				least = distance;
			}
		}
		return best;
	}

	press(event) {
		const key = this.near(event.clientX, event.clientY, REACH[event.pointerType] ?? 20);
		if (key === null || event.button !== 0 || this.held)
			return;
		event.preventDefault();
		const at = this.paper(event.clientX, event.clientY), [x, y] = this.handles.get(key).point;
		this.held = { key, pointer: event.pointerId, offset: [x - at[0], y - at[1]] };
		this.element.setPointerCapture(event.pointerId);
		this.element.setAttribute('data-held', '');
		this.focus(key);
	}

	drag(event) {
		if (!this.held) {
			this.element.toggleAttribute('data-near', event.pointerType === 'mouse' &&
				this.near(event.clientX, event.clientY, REACH.mouse) !== null);
			return;
		}
		if (event.pointerId !== this.held.pointer)
			return;
		const { key, offset } = this.held, at = this.paper(event.clientX, event.clientY);
		this.move(key, [at[0] + offset[0], at[1] + offset[1]]);
	}

	release(event) {
		if (event.pointerId === this.held?.pointer)
			this.letGo();
	}

	letGo() {
		this.held = undefined;
		this.element.removeAttribute('data-held');
	}

	pressKey(event) {
		const key = this.chosen, arrow = ARROWS[event.key];
		if (!this.handles.get(key)?.element.contains(event.target))
			return;
		if (arrow && !event.ctrlKey && !event.metaKey) {
			const step = event.shiftKey ? COARSE : event.altKey ? FINE : STEP;
			const [x, y] = this.handles.get(key).point;
			this.move(key, [x + arrow[0] * step, y + arrow[1] * step]);
			event.preventDefault();
		} else if (this.keyed(key, event)) {
			event.preventDefault();
		}
	}

	/* Points stay on the paper. */
	move(key, [x, y]) {
		this.moved(key, [onGrid(Math.min(Math.max(x, 0), this.width)),
			onGrid(Math.min(Math.max(y, 0), this.height))]);
	}
}
