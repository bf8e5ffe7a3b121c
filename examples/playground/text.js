/* text.js - numbers as people read them, in the places of the page that name them. */
'use strict';

/* With a true minus sign, and a dash where there is no number. */
function say(value, digits = 2) {
	if (!Number.isFinite(value))
		return '–';
	const text = value.toFixed(digits);
	return (Number(text) === 0 ? text.replace('-', '') : text).replace('-', '−');
}

/* Texts stand in elements that name them: data-show. */
const shown = new Map();

function show(texts) {
	for (const [name, text] of Object.entries(texts)) {
		if (!shown.has(name)) {
			const node = new Text();
			document.querySelector(`[data-show="${name}"]`).append(node);
			shown.set(name, node);
		}
		if (shown.get(name).data !== text)
			shown.get(name).data = text;
	}
}
