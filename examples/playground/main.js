/* main.js - the state of the page, and the one way in which it changes: set, then update. */
'use strict';

const REGION = [16, 12], BELOW = [16, 9];
const WARM = 20, KEPT = 240;    /* updates: from when on their times are told; of which they are kept */

async function start() {
	const library = await Library.load(KERNELS);
	const state = { preset: 'Polygon', scale: 4 };
	const times = [];
	let announcement;

	const byId = id => document.getElementById(id);
	byId('failure').hidden = true;
	document.querySelector('main').hidden = false;

	function reset() {
		const { path, centre, filter } = PRESETS[state.preset];
		state.shape = new Shape(path);
		state.centre = centre;
		state.filterAt = filter;
	}

	function moved(key, at) {
		if (key === 'centre')
			state.centre = at;
		else if (key === 'filter')
			state.filterAt = at;
		else
			state.shape.move(key, at);
		update();
	}

	function keyed(key, event) {
		const action = { Insert: add, '+': add, Delete: remove, Backspace: remove, c: bend,
			C: bend }[event.key];
		if (!action || event.ctrlKey || event.metaKey || event.altKey)
			return false;
		action();
		return true;
	}

	const region = new RegionFigure(byId('region'), REGION, { moved, keyed, resized: update });
	const pictures = new Pictures(byId('pictures'), REGION);
	const below = new BelowFigure(byId('below'), BELOW, () => update());

	/* contour, node, control of the point that was chosen last; the first if it was none. */
	function chosen() {
		const numbers = (region.figure.chosen ?? '').split('.').map(Number);
		return Number.isInteger(numbers[1]) ? numbers : [0, 0];
	}

	function edit(change) {
		const key = change(...chosen());
		update();
		region.figure.focus(key);
	}

	const add = () => edit((contour, node) => state.shape.split(contour, node));
	const remove = () => edit((...point) => state.shape.remove(...point));
	const bend = () => edit((contour, node) => state.shape.bend(contour, node));

	/* Everything anew, from the coordinates alone. What is timed: the kernels, the drawing and its
	 * layout; the browser paints afterwards. */
	function update() {
		const begin = performance.now();
		const result = library.region(state.shape.path(), TOLERANCE);
		result.distance = library.distance(state.centre);
		result.mean = result.distance / result.area;
		Object.assign(result, library.filter(state.scale, state.filterAt));
		region.draw(state, result);
		pictures.draw(library, state.scale, state.filterAt);
		Object.assign(result, below.draw(library));
		show({ ...regionTexts(state, result), ...below.texts(result) });
		document.body.getBoundingClientRect();
		times.push(performance.now() - begin);
		if (times.length > KEPT)
			times.shift();
		Object.assign(window.playground, { result, updates: window.playground.updates + 1 });
		afterwards();
	}

	/* What nobody needs while a point moves: the time it took, and news for those who listen. */
	function afterwards() {
		clearTimeout(announcement);
		announcement = setTimeout(() => {
			const { area, cx, cy, below } = window.playground.result;
			const median = [...times].sort((a, b) => a - b)[times.length >> 1];
			show({ cost: `${times.length < WARM ? '' : 'Everything above was computed and drawn anew ' +
				`in ${say(median, 1)} ms, the median of ${times.length} updates. `}Kernels: ` +
				`${library.target}. No request leaves this page.` });
			byId('announcer').textContent = `Area ${say(area, 3)}, centroid ${say(cx)}, ` +
				`${say(cy)}. Area below the segment ${say(below, 3)}.`;
		}, 600);
	}

	function choosePreset(name) {
		state.preset = name;
		reset();
		region.figure.choose(null);
		update();
	}

	for (const name of Object.keys(PRESETS)) {
		const label = document.createElement('label'), input = document.createElement('input');
		Object.assign(input, { type: 'radio', name: 'preset', value: name,
			checked: name === state.preset });
		input.addEventListener('change', () => choosePreset(name));
		const text = document.createElement('span');
		text.append(name);
		label.append(input, text);
		byId('presets').append(label);
	}
	for (const [id, action] of Object.entries({ add, remove, bend }))
		byId(id).addEventListener('click', action);
	byId('reset').addEventListener('click', () => choosePreset(state.preset));
	byId('zoom').addEventListener('input', event => {
		state.scale = 2 ** Number(event.target.value);
		update();
	});
	byId('region').addEventListener('dblclick', event => {
		const at = region.figure.paper(event.clientX, event.clientY);
		const { contour, node, t, distance } = state.shape.nearest(at);
		if (distance * region.figure.unit > REACH.touch || !(t > 0 && t < 1))
			return;
		const key = state.shape.split(contour, node, t);
		update();
		region.figure.focus(key);
	});
	const recolour = () => {
		library.palette = Pictures.palette();
		update();
	};
	matchMedia('(prefers-color-scheme: dark)').addEventListener('change', recolour);

	window.playground = { library, state, pictures, below, times, updates: 0 };
	reset();
	region.figure.fit();
	below.figure.fit();
	recolour();
}

start().catch(error => {
	const failure = document.getElementById('failure');
	failure.textContent = `The kernels could not be started: ${error.message}`;
	failure.hidden = false;
});
