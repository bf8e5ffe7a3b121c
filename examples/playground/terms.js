/* terms.js - the area, edge by edge: what each adds, from the sum so far to the next, as a row of
 * steps that ends at the area. */
'use strict';

const HIGH = 100, PAD = 8;       /* of the steps; they are stretched to the room they have */
const WIDE = 100, GAP = 0.08;    /* on each side of a step, of its share of the width */

class Terms {
	constructor(element) {
		set(element, { viewBox: `0 0 ${WIDE} ${HIGH}`, preserveAspectRatio: 'none' });
		this.parts = Object.fromEntries(['zero', 'total', 'plus', 'minus', 'links', 'one'].map(part =>
			[part, svg(element, 'path', { class: part })]));
	}

	/* `chosen` is the index of one edge, or -1. */
	draw(terms, chosen) {
		const sums = [0];
		for (const term of terms)
			sums.push(sums[sums.length - 1] + term);
		const least = Math.min(...sums), range = Math.max(...sums) - least || 1;
		const y = sum => (HIGH - PAD - (sum - least) / range * (HIGH - 2 * PAD)).toFixed(2);
		const x = place => (place * WIDE / terms.length).toFixed(2);
		const bar = i => `M${x(i + GAP)} ${y(sums[i])}H${x(i + 1 - GAP)}V${y(sums[i + 1])}` +
			`H${x(i + GAP)}Z`;
		const bars = test => terms.map((term, i) => test(term) ? bar(i) : '').join('');
		const link = (sum, i) => `M${x(i + 1 - GAP)} ${y(sum)}H${x(i + 1 + GAP)}`;
		const level = sum => `M0 ${y(sum)}H${WIDE}`;
		const paths = { zero: level(0), total: level(sums[terms.length]),
			plus: bars(term => term > 0), minus: bars(term => term < 0),
			links: sums.slice(1, -1).map(link).join(''), one: chosen < 0 ? '' : bar(chosen) };
		for (const [part, d] of Object.entries(paths))
			set(this.parts[part], { d });
	}
}
