/* filter_list.h - the filters of a program: the built-in ones, or with CUSTOM_FILTERS the files of
 * tests/filters, and what they are by the tests' own definitions: B-splines by convolution, cubics
 * by the formula of Mitchell and Netravali, the rest as the rational tables below.
 *
 * FILTER_LIST(FILTER) has a row (name, definition, max |f|, size, unity) for each: pixels per axis,
 * or 0 where knots are not pixels apart; whether it is a partition of unity.
 */
#ifndef FILTER_LIST_H
#define FILTER_LIST_H

#include "window_reference.h"

#ifdef CUSTOM_FILTERS

/* ---- tests/filters ---- */

static const WindowAxis ramps_axis[] = {
	{ "-2/3", "-1/3", { "1", "1" } },
	{ "1/3", "5/4", { "1/5", "-1", "0", "2" } }
};

static const WindowPatch roof_patches[] = {
	{ "0", "1", "0", "1", { { "9/10", 0, 0 }, { "-9/10", 1, 0 }, { "-9/10", 0, 1 },
		{ "9/5", 1, 1 }, { "-9/10", 2, 1 }, { "-9/10", 1, 2 }, { "9/10", 2, 2 } } },
	{ "-1", "0", "0", "1", { { "9/10", 0, 0 }, { "9/10", 1, 0 }, { "-9/10", 0, 1 },
		{ "-9/5", 1, 1 }, { "-9/10", 2, 1 }, { "9/10", 1, 2 }, { "9/10", 2, 2 } } },
	{ "-1", "0", "-1", "0", { { "9/10", 0, 0 }, { "9/10", 1, 0 }, { "9/10", 0, 1 },
		{ "9/5", 1, 1 }, { "9/10", 2, 1 }, { "9/10", 1, 2 }, { "9/10", 2, 2 } } },
	{ "0", "1", "-1", "0", { { "9/10", 0, 0 }, { "-9/10", 1, 0 }, { "9/10", 0, 1 },
		{ "-9/5", 1, 1 }, { "9/10", 2, 1 }, { "-9/10", 1, 2 }, { "9/10", 2, 2 } } }
};

static const WindowPatch patches_patches[] = {
	{ "0", "1/3", "-1/2", "5/7", { { "1/3", 0, 0 }, { "-1", 0, 1 }, { "3", 2, 1 } } },
	{ "1/3", "2", "0", "1", { { "1", 0, 0 }, { "-1/2", 1, 1 }, { "1/8", 3, 2 } } },
	{ "-1", "0", "1/7", "1", { { "1", 1, 1 } } }
};

/* max |f|: (11/20)^2; k(5/4)^2 is 8.167; the top of the roof; 1 - x y/2 + x^3 y^2/8 at y = 0 */
#define FILTER_LIST(FILTER) \
	FILTER(spline5, window_bspline(5), 0.3025, 6, true) \
	FILTER(ramps, window_separable(ramps_axis, 2, false), 8.2, 0, false) \
	FILTER(roof, window_bivariate(roof_patches, 4), 0.9, 2, false) \
	FILTER(patches, window_bivariate(patches_patches, 3), 1, 0, false)

#else

#define FILTER_LIST(FILTER) \
	FILTER(box, window_bspline(0), 1, 1, true) \
	FILTER(tent, window_bspline(1), 1, 2, true) \
	FILTER(bspline2, window_bspline(2), 0.5625, 3, true) \
	FILTER(bspline3, window_bspline(3), 0.4445, 4, true) \
	FILTER(catmull_rom, window_cubic(0, 3), 1, 4, true) \
	FILTER(mitchell, window_cubic(1, 2), 0.7902, 4, true)

#endif

#define FILTER_DEFINITION(name, definition, most, size, unity) \
static WindowFilter *define_##name(void) \
{ \
	return definition; \
}

FILTER_LIST(FILTER_DEFINITION)

#endif
