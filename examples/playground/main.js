/* main.js - the page: its state, what changes it, and one way to show it, which is everything anew. */
'use strict';

const REGION = [16, 12], BELOW = [16, 9];    /* sizes of the two drawings */
const WARM = 20, KEPT = 240;                 /* times of updates: needed to be told, and kept */
const QUIET = 600;                           /* ms without an update until one is announced */

const byId = id => document.getElementById(id);

class Playground {
	constructor(library) {
		this.library = library;
		this.state = { preset: 'Polygon', scale: 4 };
		this.times = [];
		this.updates = 0;
		const redraw = () => this.update();
		this.region = new RegionFigure(byId('region'), REGION, { redraw,
			moved: (key, at) => this.moved(key, at), keyed: (key, event) => this.keyed(event) });
		this.terms = new Terms(byId('terms'));
		this.pictures = new Pictures(byId('pictures'), REGION);
		this.below = new BelowFigure(byId('below'), BELOW, redraw);
		this.listen();
		this.reset();
		this.recolour();
	}

	listen() {
		for (const name of Object.keys(PRESETS))
			byId('presets').append(this.preset(name));
		for (const action of ['add', 'remove', 'bend', 'reset'])
			byId(action).addEventListener('click', () => this[action]());
		byId('zoom').addEventListener('input', event => {
			this.state.scale = 2 ** Number(event.target.value);
			this.update();
		});
		byId('region').addEventListener('dblclick', event => this.addAt(event));
		matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.recolour());
	}

	preset(name) {
		const label = document.createElement('label'), input = document.createElement('input');
		Object.assign(input, { type: 'radio', name: 'preset', value: name,
			checked: name === this.state.preset });
		input.addEventListener('change', () => {
			this.state.preset = name;
			this.reset();
		});
		label.append(input, name);
		return label;
	}

	/* ---- changes ---- */

	reset() {
		const { path, centre, filter } = PRESETS[this.state.preset];
		Object.assign(this.state, { shape: new Shape(path), centre, filterAt: filter });
		this.region.figure.choose(null);
		this.update();
	}

	recolour() {
		this.library.palette = Pictures.palette();
		this.update();
	}

	moved(key, at) {
		if (key === 'centre')
			this.state.centre = at;
		else if (key === 'filter')
			this.state.filterAt = at;
		else
			this.state.shape.move(key, at);
		this.update();
	}

	keyed({ key, ctrlKey, metaKey, altKey }) {
		const action = { Insert: 'add', '+': 'add', Delete: 'remove', Backspace: 'remove', c: 'bend',
			C: 'bend' }[key];
		if (!action || ctrlKey || metaKey || altKey)
			return false;
		this[action]();
		return true;
	}

	/* The focus stays on a button that was pressed; on a point it goes to the one that is chosen. */
	edit(change) {
		const { figure } = this.region, inside = figure.element.contains(document.activeElement);
		const key = change(...this.region.chosen ?? [0, 0]);
		this.update();
		if (inside)
			figure.focus(key);
		else
			figure.choose(key);
		this.update();
	}

	add() {
		this.edit((contour, node) => this.state.shape.split(contour, node));
	}

	remove() {
		this.edit((...point) => this.state.shape.remove(...point));
	}

	bend() {
		this.edit((contour, node) => this.state.shape.bend(contour, node));
	}

	/* Where an edge is, and no point. */
	addAt({ clientX, clientY }) {
		const { figure } = this.region;
		const edge = this.state.shape.nearest(figure.paper(clientX, clientY));
		if (edge.distance * figure.unit <= REACH.mouse &&
			figure.near(clientX, clientY, REACH.mouse / 2) === null)
			this.edit(() => this.state.shape.split(edge.contour, edge.node, edge.t));
	}

	/* ---- everything anew ---- */

	measure() {
		const { library, state } = this, [contour, node] = this.region.chosen ?? [];
		const edges = [...state.shape.edges()], result = library.region(state.shape.path(), TOLERANCE);
		result.terms = edges.map(({ points, weight }) => library.term(points, weight));
		result.edge = edges.findIndex(edge => edge.contour === contour && edge.node === node);
		result.distance = library.distance(state.centre);
		result.mean = result.distance / result.area;
		return Object.assign(result, library.filter(state.scale, state.filterAt));
	}

	/* What is timed: the kernels, the drawing and its layout; the browser paints afterwards. */
	update() {
		const begin = performance.now(), { library, state } = this, result = this.measure();
		this.region.draw(state, result);
		this.terms.draw(result.terms, result.edge);
		this.pictures.draw(library, state.scale, state.filterAt);
		Object.assign(result, this.below.draw(library));
		show({ ...regionTexts(state, result), ...this.below.texts(result) });
		document.body.getBoundingClientRect();
		this.times.push(performance.now() - begin);
		if (this.times.length > KEPT)
			this.times.shift();
		this.result = result;
		this.updates++;
		clearTimeout(this.announcement);
		this.announcement = setTimeout(() => this.announce(), QUIET);
	}

	/* For those who listen, and how long it took: when nothing has moved for a while. */
	announce() {
		const { area, cx, cy, below } = this.result, { length } = this.times;
		const median = [...this.times].sort((a, b) => a - b)[length >> 1];
		show({ cost: (length < WARM ? '' : 'Everything above was computed and drawn anew in ' +
			`${say(median, 1)} ms, the median of ${length} updates. `) +
			`Kernels: ${this.library.target}. No request leaves this page.` });
		byId('announcer').textContent = `Area ${say(area, 3)}, centroid ${say(cx)}, ${say(cy)}. ` +
			`Area below the segment ${say(below, 3)}.`;
	}
}

function fail(error) {
	byId('failure').textContent = `The kernels could not be started: ${error.message}`;
	byId('failure').hidden = false;
}

Library.load(KERNELS).then(library => {
	document.querySelector('main').hidden = false;
	window.playground = new Playground(library);
}).catch(fail);
