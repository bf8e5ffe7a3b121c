/* playground.mjs BUILD - the page of examples/playground, as people use it; see playground.sh.
 *
 * After every change all numbers that the page computed are asked from the library anew, by
 * BUILD/tests/playground, and must have the same bits; what is written on the page must be these
 * numbers, rounded. */
import { execFileSync } from 'node:child_process';
import { readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const build = resolve(process.argv[2]);
const folder = `${build}/playground`, file = `${folder}/index.html`;
const { chromium } = createRequire(`${folder}/`)('playwright-core');
const HEAVIEST = 200000;    /* bytes, for all that is loaded */
const SLOWEST = 4;          /* ms, for an update of everything */
const TOLERANCE = 2 ** -14; /* of chords, as the page says */

function verdict(name, problem) {
	console.log(problem ? `not ok ${name}: ${problem}` : `ok ${name}`);
}

/* ---- the library ---- */

function ask(questions) {
	const text = execFileSync(`${build}/tests/playground`, { input: questions.join('\n') + '\n',
		encoding: 'utf8' });
	return text.trimEnd().split('\n').map(line => line.trim().split(/\s+/).map(Number));
}

/* Rings of the region: its vertices, or the chords that the page took for curves. */
function rings({ path, curved, chords }) {
	if (curved)
		return chords;
	const list = [];
	let at = 0;
	for (const verb of path.verbs) {
		if (verb === 0)
			list.push([]);
		if (verb < 2)
			list[list.length - 1].push(path.points.slice(2 * at, 2 * ++at));
	}
	return list;
}

/* The numbers that the page should have. */
function expected(seen) {
	const { path, centre, filterAt, scale, below, curved } = seen, list = rings(seen);
	const answers = ask([`path ${path.verbs.length} ${path.points.length / 2} ` +
		`${path.weights.length} ${[...path.verbs, ...path.points, ...path.weights].join(' ')}`,
	...list.map(ring => `ring ${ring.length} ${ring.flat().join(' ')}`),
	`distance ${centre.join(' ')}`, `filters ${scale} ${filterAt.join(' ')}`,
	`below ${below.join(' ')}`]);
	const [moments, ...rest] = answers, of_rings = rest.slice(0, list.length);
	const [[distance], [box, tent, mitchell], [under, coverage]] = rest.slice(list.length);
	const result = { distance, box, tent, mitchell, below: under, coverage };
	let central;
	if (curved || list.length > 1) {
		const c = [moments[1] / moments[0], moments[2] / moments[0]];
		Object.assign(result, { area: moments[0], bound: NaN, cx: c[0], cy: c[1] });
		[central] = ask([`translate ${-c[0]} ${-c[1]} ${moments.join(' ')}`]);
	} else {
		const [ring] = of_rings;
		Object.assign(result, { area: ring[0], bound: ring[6], cx: ring[12], cy: ring[13] });
		central = ring.slice(14);
	}
	result.terms = ask(seen.edges.map(({ points, weight }) => weight === undefined ?
		`edge ${points.length} ${points.flat().join(' ')}` :
		`edge 0 ${points.flat().join(' ')} ${weight}`)).flat();
	[result.m20, result.m11, result.m02] = central.slice(3);
	result.mean = result.distance / result.area;
	return result;
}

/* ---- the page ---- */

/* What it holds, and what is written on it. */
function look(page) {
	return page.evaluate(() => {
		const { library, state, below, result } = playground;
		const { u0, u1, v0, v1 } = below.rectangle, path = state.shape.path();
		const x = library.array(Float64Array, 'vertex_x', result.lines);
		const y = library.array(Float64Array, 'vertex_y', result.lines);
		const offsets = library.array(Int32Array, 'offsets', state.shape.contours.length + 1);
		const chords = state.shape.contours.map((_, i) => [...x.subarray(offsets[i],
			offsets[i + 1])].map((v, k) => [v, y[offsets[i] + k]]));
		return { path, result: { ...result }, centre: state.centre, filterAt: state.filterAt,
			scale: state.scale, below: [...below.p, ...below.q, u0, u1, v0, v1],
			curved: state.shape.curved, chords, edges: [...state.shape.edges()], updates: playground.updates,
			texts: Object.fromEntries([...document.querySelectorAll('[data-show]')].map(element =>
				[element.dataset.show, element.textContent])) };
	});
}

const DIGITS = { area: 10, m20: 6, m11: 6, m02: 6, distance: 6, mean: 6, box: 6, tent: 6,
	mitchell: 6, below: 10, coverage: 10 };

/* What is wrong with it; nothing if all is right. */
function wrong(seen) {
	const right = expected(seen);
	for (const [name, value] of Object.entries(right))
		if (![value].flat().every((v, i) => Object.is([seen.result[name]].flat()[i], v)))
			return `${name} is ${seen.result[name]}, the library says ${value}`;
	for (const [name, digits] of Object.entries(DIGITS)) {
		const text = seen.texts[name].replace('−', '-');
		if (Number(text) !== Number(right[name].toFixed(digits)))
			return `${name} is written ${text}, but is ${right[name]}`;
	}
	const pair = seen.texts.centroid.replaceAll('−', '-').match(/[-\d.]+/g).map(Number);
	if (pair[0] !== Number(right.cx.toFixed(6)) || pair[1] !== Number(right.cy.toFixed(6)))
		return `the centroid is written ${seen.texts.centroid}`;
	return null;
}

async function settle(page, name, before, after = () => null) {
	const seen = await look(page);
	verdict(name, seen.updates > before.updates ? after(seen) ?? wrong(seen) : 'nothing happened');
	return seen;
}

/* Where a point of a drawing is on the screen. */
async function place(page, drawing, label) {
	const box = await page.locator(`#${drawing}`).getByRole('slider', { name: label, exact: true })
		.locator('.mark').boundingBox();
	return [box.x + box.width / 2, box.y + box.height / 2];
}

const choose = (page, preset) => page.getByLabel(preset, { exact: true }).check();
const vertex = ({ path }, i) => path.points.slice(2 * i, 2 * i + 2);

async function dragByMouse(page, [x, y], [dx, dy], steps = 12) {
	await page.mouse.move(x, y);
	await page.mouse.down();
	for (let i = 1; i <= steps; i++)
		await page.mouse.move(x + dx * i / steps, y + dy * i / steps);
	await page.mouse.up();
}

async function dragByFinger(page, [x, y], [dx, dy], steps = 12) {
	const session = await page.context().newCDPSession(page);
	const touch = (type, ...points) => session.send('Input.dispatchTouchEvent', { type,
		touchPoints: points.map(([px, py]) => ({ x: px, y: py })) });
	await touch('touchStart', [x, y]);
	for (let i = 1; i <= steps; i++)
		await touch('touchMove', [x + dx * i / steps, y + dy * i / steps]);
	await touch('touchEnd');
}

/* ---- tests ---- */

async function testPresets(page) {
	for (const preset of ['Star', 'Letter', 'Circle', 'Polygon']) {
		const before = await look(page);
		await choose(page, preset);
		const seen = await settle(page, `${preset}: numbers`, before);
		if (seen.curved)
			verdict(`${preset}: ${seen.result.lines} chords, as near as they are said to be`,
				await farFrom(page, seen));
	}
}

/* Points of the curves, by Bernstein polynomials, against the chords of their contour. */
async function farFrom(page, { chords }) {
	const contours = await page.evaluate(() => playground.state.shape.contours);
	const binomials = [[1, 1], [1, 2, 1], [1, 3, 3, 1]];
	let farthest = 0;
	for (const [c, contour] of contours.entries()) {
		const ring = chords[c];
		for (const [n, node] of contour.entries()) {
			const points = [node.at, ...node.controls, contour[(n + 1) % contour.length].at];
			const degree = points.length - 1;
			for (let i = 0; i <= 200; i++) {
				const t = i / 200, sum = [0, 0, 0];
				for (const [k, [x, y]] of points.entries()) {
					const b = binomials[degree - 1][k] * (1 - t) ** (degree - k) * t ** k *
						(k === 1 && node.weight !== undefined ? node.weight : 1);
					sum[0] += b * x;
					sum[1] += b * y;
					sum[2] += b;
				}
				farthest = Math.max(farthest, nearest(ring, sum[0] / sum[2], sum[1] / sum[2]));
			}
		}
	}
	return farthest <= TOLERANCE ? null : `${farthest} away`;
}

function nearest(ring, x, y) {
	let best = Infinity;
	for (const [i, [ax, ay]] of ring.entries()) {
		const [bx, by] = ring[(i + 1) % ring.length], dx = bx - ax, dy = by - ay;
		const along = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1);
		const t = Math.min(Math.max(along, 0), 1);
		best = Math.min(best, Math.hypot(ax + t * dx - x, ay + t * dy - y));
	}
	return best;
}

async function testMouse(page) {
	let before = await look(page);
	const unit = await page.evaluate(() => document.getElementById('region').clientWidth / 16);
	await dragByMouse(page, await place(page, 'region', 'Vertex 3'), [-2 * unit, unit]);
	before = await settle(page, 'mouse: a vertex', before, seen => {
		const [x, y] = vertex(before, 2), [nx, ny] = vertex(seen, 2);
		return Math.abs(nx - x + 2) <= 0.02 && Math.abs(ny - y + 1) <= 0.02 ? null :
			`from ${x}, ${y} to ${nx}, ${ny}`;
	});
	const altered = { ...before, path: { ...before.path, points: before.path.points.slice() } };
	altered.path.points[0] += 0.01;
	verdict('a vertex that is 0.01 beside is noticed', wrong(altered) ? null : 'it was not');
	await dragByMouse(page, await place(page, 'region', 'Centre of the distance'), [70, -40]);
	before = await settle(page, 'mouse: the centre of the distance', before);
	await dragByMouse(page, await place(page, 'region', 'Centre of the filter'), [-60, -33]);
	before = await settle(page, 'mouse: the filter', before);
	await dragByMouse(page, await place(page, 'region', 'Vertex 1'), [-4000, 4000]);
	before = await settle(page, 'mouse: a vertex stays on the paper', before, seen =>
		vertex(seen, 0).join() === '0,0' ? null : vertex(seen, 0).join());
	const [ax, ay] = await place(page, 'region', 'Vertex 4');
	const [bx, by] = await place(page, 'region', 'Vertex 5');
	await page.mouse.dblclick((ax + bx) / 2, (ay + by) / 2);
	before = await settle(page, 'mouse: a double click adds a vertex', before, seen =>
		seen.path.verbs.length === before.path.verbs.length + 1 ? null : 'it did not');
	await page.getByRole('button', { name: 'Curve' }).click();
	before = await settle(page, 'mouse: an edge is bent', before, seen =>
		seen.path.verbs.includes(4) ? null : 'no cubic');
	await page.getByRole('button', { name: 'Delete' }).click();
	before = await settle(page, 'mouse: a vertex is deleted', before);
	const [x, y] = await place(page, 'region', 'Vertex 2');
	await page.mouse.move(x, y);
	await page.mouse.down();
	await page.mouse.move(x + 20, y - 20);
	await page.keyboard.press('Delete');
	const deleted = await look(page);
	await page.mouse.move(x + 60, y - 60);
	await page.mouse.up();
	verdict('mouse: a vertex that is deleted while it is held is let go', vertex(deleted, 1).join() ===
		vertex(await look(page), 1).join() ? null : 'another one moves');
	await page.getByRole('button', { name: 'Reset' }).click();
	await settle(page, 'mouse: reset', before, seen => seen.curved ? 'still bent' : null);
}

async function testKeys(page) {
	await choose(page, 'Polygon');
	let before = await look(page);
	const target = page.getByRole('slider', { name: 'Vertex 2', exact: true });
	await page.getByRole('button', { name: 'Reset' }).focus();
	await page.keyboard.press('Tab');
	await page.keyboard.press('Tab');
	verdict('keys: Tab goes to the points in order',
		await target.evaluate(element => element === document.activeElement) ? null : 'it does not');
	verdict('keys: the point with the focus is marked', await target.locator('.halo').evaluate(
		element => Number(getComputedStyle(element).strokeWidth.replace('px', '')) >= 2 &&
			getComputedStyle(element).stroke !== 'none') ? null : 'it is not');
	for (const [key, dx, dy] of [['ArrowRight', 0.1, 0], ['ArrowDown', 0, -0.1],
		['Shift+ArrowUp', 0, 1], ['Alt+ArrowLeft', -0.01, 0]]) {
		await page.keyboard.press(key);
		before = await settle(page, `keys: ${key}`, before, seen => {
			const [x, y] = vertex(before, 1), [nx, ny] = vertex(seen, 1);
			const want = [x + dx, y + dy].map(v => Math.round(v * 100) / 100);
			return nx === want[0] && ny === want[1] ? null : `${nx}, ${ny}`;
		});
	}
	verdict('keys: the position is said', await target.getAttribute('aria-valuetext') ===
		`x ${vertex(before, 1)[0].toFixed(2)}, y ${vertex(before, 1)[1].toFixed(2)}` ? null :
		await target.getAttribute('aria-valuetext'));
	const adds = before.result.terms[1].toFixed(4).replace('-', '−');
	verdict('keys: what the chosen edge adds is written', before.texts.term.includes(adds) ? null :
		`${before.texts.term} and not ${adds}`);
	for (const [key, more] of [['Insert', 1], ['c', 0], ['c', 0], ['+', 1], ['Delete', -1]]) {
		await page.keyboard.press(key);
		before = await settle(page, `keys: ${key}`, before, seen =>
			seen.path.verbs.length === before.path.verbs.length + more ? null :
				`${seen.path.verbs.length} verbs`);
	}
	await page.waitForFunction(area => document.getElementById('announcer').textContent.includes(area),
		before.result.area.toFixed(3), { timeout: 5000 });
	verdict('keys: the area is announced, later');
	await page.locator('#zoom').focus();
	await page.keyboard.press('ArrowRight');
	before = await settle(page, 'keys: zoom', before, seen => seen.scale > before.scale ? null :
		`${seen.scale}`);
}

/* Nodes of every kind of edge are removed one by one, and split: no key may break the path. */
async function testEdits(page) {
	for (const preset of ['Letter', 'Circle', 'Star']) {
		await choose(page, preset);
		const problem = await page.evaluate(() => {
			const { shape } = playground.state;
			let steps = 0;
			for (let i = 0; i < 120; i++) {
				const all = [...shape.points()], { contour, node, control } = all[i * 7 % all.length];
				if (i % 3 === 1)
					shape.split(contour, node, 0.25);
				else if (i % 11 === 5)
					shape.bend(contour, node);
				else
					shape.remove(contour, node, control);
				const status = playground.library.region(shape.path(), 2 ** -14).status;
				if (status !== 0 && status !== 6)
					return `status ${status} after ${steps} edits`;
				steps++;
			}
			return shape.contours.every(contour => contour.length >= 2) ? null : 'a contour is gone';
		});
		verdict(`${preset}: 120 edits`, problem);
	}
}

/* Splitting curves does not change the region, to all digits that are written. */
async function testSplits(page) {
	for (const preset of ['Letter', 'Circle']) {
		await choose(page, preset);
		const problem = await page.evaluate(() => {
			const { shape } = playground.state, { area } = playground.result;
			for (const [c, contour] of shape.contours.entries())
				for (let n = contour.length - 1; n >= 0; n--)
					if (contour[n].controls.length > 0)
						shape.split(c, n);
			const now = playground.library.region(shape.path(), 2 ** -14).area;
			return now.toFixed(10) === area.toFixed(10) ? null : `${area} became ${now}`;
		});
		verdict(`${preset}: split curves bound the same area`, problem);
	}
}

async function testBelow(page) {
	await page.locator('#below').scrollIntoViewIfNeeded();
	let before = await look(page);
	const moves = [['End p of the segment', 40, -90], ['End q of the segment', -200, 60],
		['Opposite corner of the rectangle', 55, -40], ['Corner of the rectangle', 420, -180],
		['The rectangle, by its middle', -90, 70], ['End p of the segment', 500, -100]];
	for (const [label, dx, dy] of moves) {
		await dragByMouse(page, await place(page, 'below', label), [dx, dy]);
		before = await settle(page, `below: ${label}`, before, seen =>
			seen.below.join() === before.below.join() ? 'nothing moved' : null);
	}
	await page.keyboard.press('Shift+ArrowLeft');
	await settle(page, 'below: keys', before);
}

/* All pixels of all filters at several zooms; the canvas shows them; the one where the filter stands
 * has its weight. */
async function testPictures(page) {
	for (const preset of ['Polygon', 'Star', 'Letter', 'Circle']) {
		await choose(page, preset);
		for (const zoom of ['0', '2', '3.375', '6']) {
			await page.locator('#zoom').fill(zoom);
			const seen = await look(page);
			verdict(`${preset}: pixels at ${seen.scale.toFixed(2)} per unit`,
				await wrongPictures(page, seen));
		}
	}
}

async function wrongPictures(page, { path, scale, filterAt, result, curved }) {
	const shown = await page.evaluate(() => {
		const { library, state, pictures } = playground;
		const pixel = pictures.draw(library, state.scale, state.filterAt);
		const from = pixel.map((k, i) => state.filterAt[i] - (k + 0.5) / state.scale);
		return { pixel, from, pictures: pictures.views.map(({ filter, canvas }) => {
			const { width, height } = canvas;
			const shades = library.picture(filter, state.scale, from, [width, height]);
			const copy = new OffscreenCanvas(width, height).getContext('2d',
				{ willReadFrequently: true });
			copy.drawImage(canvas, 0, 0);
			const painted = copy.getImageData(0, 0, width, height).data;
			return { width, height,
				same: shades.every((v, i) => v === painted[i]),
				values: [...library.array(Float32Array, 'values', width * height)] };
		}) };
	});
	const { pixel, from, pictures } = shown, [{ width, height }] = pictures;
	const [, ...images] = ask([`path ${path.verbs.length} ${path.points.length / 2} ` +
		`${path.weights.length} ${[...path.verbs, ...path.points, ...path.weights].join(' ')}`,
	...pictures.map((_, i) => `image ${i} ${scale} ${from.join(' ')} ${width} ${height}`)]);
	for (const [i, name] of ['box', 'tent', 'mitchell'].entries()) {
		const { values, same } = pictures[i];
		if (!same)
			return `${name}: the canvas does not show it`;
		const bad = values.findIndex((v, k) => v !== Math.fround(images[i][k]));
		if (bad >= 0 || values.length !== images[i].length)
			return `${name}: pixel ${bad} is ${values[bad]}, the library says ${images[i][bad]}`;
		/* ew_raster's own bound, 2e-6. Curves are other chords there, up to 2^-8 pixels away; the
		 * header gives no bound on what that does to a pixel. */
		const here = values[(height - 1 - pixel[1]) * width + pixel[0]];
		if (!curved && Math.abs(here - result[name]) > 2e-6)
			return `${name}: ${here} where the filter stands, not ${result[name]}`;
	}
	return null;
}

async function testSpeed(page) {
	for (const preset of ['Polygon', 'Letter', 'Circle']) {
		await choose(page, preset);
		const before = await look(page), first = preset === 'Letter' ? 'Vertex 1 of contour 1' :
			'Vertex 1';
		for (let i = 0; i < 4; i++)
			await dragByMouse(page, await place(page, 'region', first),
				i % 2 ? [60, -30] : [-60, 30], 60);
		const { times, updates } = await page.evaluate(() => ({ times: playground.times,
			updates: playground.updates }));
		const sorted = times.slice(-Math.min(updates - before.updates, times.length))
			.sort((a, b) => a - b);
		const median = sorted[sorted.length >> 1];
		verdict(`${preset}: an update takes ${median.toFixed(2)} ms (median of ${sorted.length}, ` +
			`90 % below ${sorted[Math.floor(sorted.length * 0.9)].toFixed(2)})`,
		sorted.length >= 100 && median < SLOWEST ? null : `not below ${SLOWEST}`);
	}
}

async function testFinger(page) {
	let before = await look(page);
	await page.locator('#region').scrollIntoViewIfNeeded();
	const [x, y] = await place(page, 'region', 'Vertex 3');
	const scroll = () => page.evaluate(() => scrollY);
	const top = await scroll();
	await dragByFinger(page, [x + 12, y + 25], [-50, 40]);
	before = await settle(page, 'finger: a vertex, from 28 pixels beside it', before, seen =>
		vertex(seen, 2).join() === vertex(before, 2).join() ? 'it did not move' : null);
	verdict('finger: the page stays where it is', await scroll() === top ? null : 'it scrolled');
	const paper = await page.locator('#region').boundingBox();
	await dragByFinger(page, [paper.x + paper.width - 12, paper.y + 20], [0, -200]);
	await page.waitForTimeout(300);
	verdict('finger: where no point is near, the page scrolls', await scroll() > top ? null :
		'it did not');
	const small = await page.evaluate(() => [...document.querySelectorAll('button, .presets label, #zoom')]
		.map(element => element.getBoundingClientRect()).filter(box => box.height < 40).length);
	verdict('finger: buttons are 40 pixels high', small === 0 ? null : `${small} are not`);
}

/* Contrast of every text that is seen against what is painted behind it (WCAG 2). */
function contrasts(page) {
	return page.evaluate(() => {
		const rgb = text => text.match(/[\d.]+/g).map(Number);
		const light = c => {
			const v = c / 255;
			return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
		};
		const luminance = ([r, g, b]) => 0.2126 * light(r) + 0.7152 * light(g) + 0.0722 * light(b);
		const opaque = element => {
			for (let at = element; at; at = at.parentElement) {
				const colour = rgb(getComputedStyle(at).backgroundColor);
				if (colour.length === 3 || colour[3] === 1)
					return colour;
			}
			return [255, 255, 255];
		};
		const list = [], walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
		while (walker.nextNode()) {
			const text = walker.currentNode, element = text.parentElement;
			if (!text.data.trim() || !element.checkVisibility() || /SCRIPT|STYLE/.test(element.tagName))
				continue;
			const style = getComputedStyle(element);
			const drawn = element.namespaceURI.endsWith('svg') ? style.fill : style.color;
			const [a, b] = [luminance(rgb(drawn)), luminance(opaque(element))].sort((p, q) => q - p);
			list.push({ text: text.data.trim().slice(0, 30), contrast: (a + 0.05) / (b + 0.05) });
		}
		return list.sort((a, b) => a.contrast - b.contrast);
	});
}

async function testLooks(browser, url) {
	const sizes = { desktop: [1600, 1000], tablet: [820, 1180], phone: [360, 740] };
	for (const colorScheme of ['light', 'dark']) {
		for (const [name, [width, height]] of Object.entries(sizes)) {
			const phone = name === 'phone';
			const context = await browser.newContext({ viewport: { width, height }, colorScheme,
				deviceScaleFactor: phone ? 2 : 1, hasTouch: phone, isMobile: phone });
			const page = await context.newPage();
			await page.goto(url);
			await page.waitForFunction(() => window.playground?.updates > 0);
			await choose(page, 'Letter');
			await page.screenshot({ path: `${folder}/${name}-${colorScheme}.png`, fullPage: true });
			const [least, ...others] = await contrasts(page);
			verdict(`${name}, ${colorScheme}: ${others.length + 1} texts, contrast ` +
				`${least.contrast.toFixed(1)} at least`, least.contrast >= 4.5 && others.length > 60 ?
				null : `"${least.text}" has less than 4.5`);
			const wide = await page.evaluate(() => document.documentElement.scrollWidth);
			verdict(`${name}, ${colorScheme}: nothing is wider than the window`,
				wide <= width ? null : `${wide} pixels`);
			await context.close();
		}
	}
}

async function testMotion(browser, url) {
	const context = await browser.newContext({ reducedMotion: 'reduce' });
	const page = await context.newPage();
	await page.goto(url);
	const moving = await page.evaluate(() => [...document.querySelectorAll('*')].filter(element => {
		const style = getComputedStyle(element);
		return parseFloat(style.transitionDuration) > 0 || style.animationName !== 'none';
	}).length);
	verdict('nothing moves by itself where less motion is wanted', moving === 0 ? null :
		`${moving} elements do`);
	await context.close();
}

async function testFile(browser) {
	const page = await browser.newPage();
	await page.goto(pathToFileURL(file).href);
	await page.waitForFunction(() => window.playground?.updates > 0);
	verdict('opened from a disk: numbers', wrong(await look(page)));
	await page.close();
}

/* ---- all ---- */

/* A server that has the page and nothing else, and remembers what it was asked. */
function serve(asked) {
	const server = createServer((request, response) => {
		asked.push(request.url);
		const known = request.url === '/';
		response.writeHead(known ? 200 : 404, { 'Content-Type': 'text/html; charset=utf-8' });
		response.end(known ? readFileSync(file) : '');
	});
	return new Promise(done => server.listen(0, '127.0.0.1', () => done(server)));
}

const asked = [], complaints = [], left = [];
const server = await serve(asked);
const url = `http://127.0.0.1:${server.address().port}/`;
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM,
	args: ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
		'--disable-background-networking', '--disable-component-update', '--disable-sync'] });
try {
	const context = await browser.newContext({ viewport: { width: 1440, height: 1000 },
		hasTouch: true });
	const page = await context.newPage();
	page.on('request', request => left.push(request.url()));
	page.on('console', message => complaints.push(message.text()));
	page.on('pageerror', error => complaints.push(error.message));
	await page.goto(url);
	await page.waitForFunction(() => window.playground?.updates > 0);
	const target = await page.evaluate(() => playground.library.target);
	verdict('the kernels are those of wasm128', target === 'wasm128' ? null : target);
	await testPresets(page);
	await testMouse(page);
	await testKeys(page);
	await testEdits(page);
	await testSplits(page);
	await testPictures(page);
	await testBelow(page);
	await page.evaluate(() => scrollTo(0, 0));
	await testSpeed(page);
	await choose(page, 'Polygon');
	await testFinger(page);
	verdict('nothing is requested but the page', left.join() === url && asked.join() === '/' ?
		null : [...left, ...asked].join(' '));
	verdict('the console is silent', complaints[0]);
	const weight = statSync(file).size;
	verdict(`the page weighs ${weight} bytes`, weight < HEAVIEST ? null : `not below ${HEAVIEST}`);
	await testFile(browser);
	await testLooks(browser, url);
	await testMotion(browser, url);
} finally {
	await browser.close();
	server.close();
}
