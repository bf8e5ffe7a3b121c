/* pictures.js - the region as images, one for each filter, and the palette that shows their values.
 *
 * All are of the same size. They show the whole drawing if it fits, else what is around the filter;
 * and they are laid so that one pixel has its centre where the filter stands. */
'use strict';

const PIXELS = [64, 48];
const CAPTIONS = {
	box: ['Box', 'the part of the pixel that is covered'],
	tent: ['Tent', 'two pixels wide, continuous'],
	mitchell: ['Mitchell', 'four pixels wide, smooth and sharp'],
};

/* Light adds up, the numbers that name a colour do not. */
const toLight = c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
const fromLight = c => c <= 0.0031308 ? c * 12.92 : 1.055 * c ** (1 / 2.4) - 0.055;

class Pictures {
	constructor(parent, size) {
		this.size = size;
		this.views = FILTERS.map((filter, i) => {
			const figure = document.createElement('figure');
			const frame = document.createElement('div');
			const canvas = document.createElement('canvas');
			const spot = document.createElement('div');
			const caption = document.createElement('figcaption');
			const [name, what] = CAPTIONS[filter];
			frame.className = 'frame';
			spot.className = 'spot';
			[canvas.width, canvas.height] = PIXELS;
			canvas.setAttribute('role', 'img');
			canvas.setAttribute('aria-label', `The region in pixels, filtered by ${name}`);
			const title = document.createElement('b');
			title.append(name);
			caption.append(title, `, ${what}`);
			frame.append(canvas, spot);
			figure.append(frame, caption);
			parent.append(figure);
			return { filter, canvas, context: canvas.getContext('2d'), spot,
				support: SUPPORTS[i] };
		});
	}

	/* Of values from -1 to 2, in 256 steps each: four colours of the style sheet, and between. */
	static palette() {
		const style = getComputedStyle(document.documentElement);
		const stops = ['--under', '--page', '--full', '--over'].map(name =>
			style.getPropertyValue(name).trim().match(/[0-9a-f]{2}/gi)
				.map(c => toLight(parseInt(c, 16) / 255)));
		const colours = [];
		for (let i = 0; i <= 3 * 256; i++) {
			const part = Math.min(Math.floor(i / 256), 2), t = i / 256 - part;
			const [r, g, b] = stops[part].map((c, k) =>
				Math.round(255 * fromLight(c + (stops[part + 1][k] - c) * t)));
			colours.push(0xff000000 + (b << 16) + (g << 8) + r);
		}
		return colours;
	}

	/* Which pixel, along one axis, is centred on the filter. */
	place(axis, scale, at) {
		const whole = this.size[axis], seen = PIXELS[axis] / scale, spare = whole - seen;
		const from = spare < 0 ? spare / 2 : Math.min(Math.max(at - seen / 2, 0), spare);
		return Math.floor((at - from) * scale);
	}

	draw(library, scale, filterAt) {
		const pixel = [0, 1].map(axis => this.place(axis, scale, filterAt[axis]));
		const from = pixel.map((k, axis) => filterAt[axis] - (k + 0.5) / scale);
		for (const { filter, context, spot, support } of this.views) {
			const shades = library.picture(filter, scale, from, PIXELS);
			context.putImageData(new ImageData(shades, ...PIXELS), 0, 0);
			const percent = (pixels, axis) => `${100 * pixels / PIXELS[axis]}%`;
			Object.assign(spot.style, { width: percent(support, 0), height: percent(support, 1),
				left: percent(pixel[0] + (1 - support) / 2, 0),
				bottom: percent(pixel[1] + (1 - support) / 2, 1) });
		}
		return pixel;
	}
}
