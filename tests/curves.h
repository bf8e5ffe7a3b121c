/* curves.h - what the tests of curves and paths share: single edges in both precisions behind one
 * call, the bounds of their kernels, targets one after another, random control points.
 *
 * As in rings.h a test is written once for an Api, with coordinates that the precision can hold.
 */
#ifndef CURVES_H
#define CURVES_H

#include "rings.h"

#include "curve_reference.h"

enum { CURVE_DEGREE = EW_MAX_CURVE_DEGREE, CURVE_MOMENTS = EW_MOMENTS(CURVE_DEGREE) };

_Static_assert(EW_MAX_CURVE_DEGREE <= (int)CURVE_MAX_DEGREE, "the reference ends too early");

static const char *const curve_names[CURVE_KINDS] = {
	[CURVE_LINE] = "line", [CURVE_QUAD] = "quad", [CURVE_CONIC] = "conic",
	[CURVE_CUBIC] = "cubic"
};

/* Areas and moments of one edge. */

#define POINT(REAL, i) (REAL)c->x[i], (REAL)c->y[i]
#define LINE_POINTS(REAL) POINT(REAL, 0), POINT(REAL, 1)
#define QUAD_POINTS(REAL) LINE_POINTS(REAL), POINT(REAL, 2)
#define CONIC_POINTS(REAL) QUAD_POINTS(REAL), (REAL)c->w
#define CUBIC_POINTS(REAL) QUAD_POINTS(REAL), POINT(REAL, 3)

#define CURVE_FUNCTIONS(REAL, f) \
static inline double one_area##f(const Curve *c) \
{ \
	switch (c->kind) { \
	case CURVE_LINE: return (double)ew_line_area##f(LINE_POINTS(REAL)); \
	case CURVE_QUAD: return (double)ew_quad_area##f(QUAD_POINTS(REAL)); \
	case CURVE_CONIC: return (double)ew_conic_area##f(CONIC_POINTS(REAL)); \
	default: return (double)ew_cubic_area##f(CUBIC_POINTS(REAL)); \
	} \
} \
static inline int one_moments##f(int degree, const Curve *c, void *out) \
{ \
	switch (c->kind) { \
	case CURVE_LINE: return ew_line_moments##f(degree, LINE_POINTS(REAL), out); \
	case CURVE_QUAD: return ew_quad_moments##f(degree, QUAD_POINTS(REAL), out); \
	case CURVE_CONIC: return ew_conic_moments##f(degree, CONIC_POINTS(REAL), out); \
	default: return ew_cubic_moments##f(degree, CUBIC_POINTS(REAL), out); \
	} \
}

CURVE_FUNCTIONS(double, )
CURVE_FUNCTIONS(float, f)

static inline double area_of(const Api *api, const Curve *c)
{
	return api->bits == 24 ? one_areaf(c) : one_area(c);
}

static inline int moments_of(const Api *api, int degree, const Curve *c, void *out)
{
	return api->bits == 24 ? one_momentsf(degree, c, out) : one_moments(degree, c, out);
}

/* Roundings of one edge: k of the kernel that computes all moments of this degree. */
static inline const Row *curve_row(int kind, int degree)
{
	static const int ids[CURVE_KINDS][CURVE_DEGREE + 1] = {
		[CURVE_LINE] = { EW_IDS_LINE }, [CURVE_QUAD] = { EW_IDS_QUAD },
		[CURVE_CONIC] = { EW_IDS_CONIC }, [CURVE_CUBIC] = { EW_IDS_CUBIC }
	};
	return &ring_rows[ids[kind][degree]];
}

/* for (unsigned target = 0; next_target(&target);): all that this machine has, each in use; in the
 * end the best again. */
static inline bool next_target(unsigned *target)
{
	const unsigned targets = ew_targets();
	do {
		*target = *target ? *target << 1 : 1;
	} while (*target && !(targets & *target));
	if (ew_use_target(*target) != EW_OK) {
		printf("not ok target %s: refused, though ew_targets has it\n",
			ew_target_name(*target));
		exit(1);
	}
	return *target != 0;
}

static inline Api const *next_api(const Api *api)
{
	return !api ? apis : api + 1 < apis + APIS ? api + 1 : NULL;
}

/* Control points. */

static inline void curve_round(const Api *api, Curve *c)
{
	for (int i = 0; i < CURVE_POINTS; i++) {
		c->x[i] = round_to(api->bits, c->x[i]);
		c->y[i] = round_to(api->bits, c->y[i]);
	}
	c->w = round_to(api->bits, c->w);
}

typedef enum { UNIFORM, INTEGERS, FAR, SCALED, FLAT, AXES, CLASSES } Class;

static const char *const class_names[CLASSES] = {
	"uniform", "integers", "far", "scaled", "flat", "axes"
};

static inline double random_coordinate(const Api *api, Class class)
{
	const int scale = api->bits == 24 ? 3 : 12;
	switch (class) {
	case INTEGERS: return random_int(-20, 20);
	case SCALED: return random_scaled(-scale, scale);
	case AXES: return random_int(0, 2) ? random_real(-4, 4) : 0;
	default: return random_real(-1, 1);
	}
}

static inline Curve random_curve(const Api *api, int kind, Class class)
{
	Curve c = { .kind = kind, .w = 1 };
	const double away = class == FAR ? 500 : 0;
	const double cx = random_real(-away, away);
	const double cy = random_real(-away, away);
	for (int i = 0; i < curve_points(kind); i++) {
		c.x[i] = cx + random_coordinate(api, class);
		c.y[i] = cy + random_coordinate(api, class) * (class == FLAT ? 0x1p-6 : 1);
	}
	curve_round(api, &c);
	return c;
}

/* Messages. */

static inline const char *curve_text(const Curve *c)
{
	static char text[400];
	const int points = curve_points(c->kind);
	int length = snprintf(text, sizeof text, "%s", curve_names[c->kind]);
	for (int i = 0; i < points; i++)
		length += snprintf(text + length, sizeof text - (size_t)length, " (%.17g,%.17g)",
			c->x[i], c->y[i]);
	if (c->kind == CURVE_CONIC)
		snprintf(text + length, sizeof text - (size_t)length, " w %.17g", c->w);
	return text;
}

/* All numbers of an array of the precision are NaN or infinite. */
static inline bool all_nonfinite(const Api *api, const void *v, int count)
{
	for (int i = 0; i < count; i++) {
		if (isfinite(get(api, v, i)))
			return false;
	}
	return true;
}

/* The area of a curve that has a NaN or an infinity, and its moments of every degree. */
static inline void expect_nonfinite(const Api *api, const Curve *c)
{
	expect(!isfinite(area_of(api, c)), "area is finite: %s", curve_text(c));
	for (int d = 0; d <= CURVE_DEGREE; d++) {
		double out[CURVE_MOMENTS];
		moments_of(api, d, c, out);
		expect(all_nonfinite(api, out, ref_count(d)),
			"a moment of degree %d is finite: %s", d, curve_text(c));
	}
}

/* Samples: curves with their exact moments, and what the library said of them so far. */

enum { CANARY = 0x88, MARGIN = 16 };

typedef struct {
	Curve curve;
	Ref *area, *moments;    /* for degree 0, and for those above */
	double got[CURVE_DEGREE + 1][CURVE_MOMENTS];    /* of either precision, if seen */
	unsigned seen;          /* the target that gave it */
} Sample;

static inline void sample_init(Sample *s, const Curve *c)
{
	s->curve = *c;
	s->seen = 0;
	s->area = ref_new(1);
	s->moments = ref_new(CURVE_MOMENTS);
	curve_add(s->area, 0, c);
	curve_add(s->moments, CURVE_DEGREE, c);
}

static inline void sample_free(Sample *s)
{
	ref_free(s->area, 1);
	ref_free(s->moments, CURVE_MOMENTS);
}

/* Calls the library between canaries; false if it refuses or writes too much. */
static inline bool sample_call(const Api *api, const Curve *c, int degree, void *out)
{
	const size_t bytes = (size_t)ref_count(degree) * api->size;
	unsigned char room[MARGIN + CURVE_MOMENTS * sizeof(double) + MARGIN];
	memset(room, CANARY, sizeof room);
	if (!expect(moments_of(api, degree, c, room + MARGIN) == EW_OK, "degree %d refused: %s",
		degree, curve_text(c)))
		return false;
	memcpy(out, room + MARGIN, bytes);
	for (size_t i = 0; i < sizeof room; i++) {
		if (!expect(room[i] == CANARY || (i >= MARGIN && i < MARGIN + bytes),
			"degree %d writes at byte %ld of %zu", degree, (long)i - MARGIN, bytes))
			return false;
	}
	return true;
}

/* What underflow may add to moments of curves: the weight of a conic is one more factor. */
static inline double curve_tiny(const Api *api, const Curve *c, int degree, long k)
{
	double x[CURVE_POINTS + 1] = { 0 }, y[CURVE_POINTS + 1] = { 0 };
	memcpy(x, c->x, sizeof c->x);
	memcpy(y, c->y, sizeof c->y);
	if (c->kind == CURVE_CONIC && isfinite(c->w))
		x[CURVE_POINTS] = fmin(fabs(c->w), 1);
	return ref_tiny(k, degree, api->bits, x, y, CURVE_POINTS + 1);
}

/* Holds moments of this degree against exact ones, within gamma_k W; the largest error goes to
 * *worst, if it can be told from underflow. */
static inline void expect_moments(const Api *api, const void *got, const Ref *want, int degree,
	long k, double tiny, double *worst, const char *what)
{
	for (int i = 0; i < ref_count(degree); i++) {
		const double v = get(api, got, i);
		expect_within(v, &want[i], k, api->bits, tiny, "moment %d of degree %d of %s", i,
			degree, what);
		if (ldexp(tiny, api->bits) < mpq_get_d(want[i].weight) * 0.01)
			*worst = fmax(*worst, ref_units(v, &want[i], api->bits));
	}
}

/* All degrees under the target in use. A target with the bits of another that was held against the
 * exact moments is right too; those with FMA must have the same. */
static inline void sample_test(const Api *api, Sample *s, unsigned target, const long *k,
	double *worst)
{
	for (int d = 0; d <= CURVE_DEGREE; d++) {
		double got[CURVE_MOMENTS];
		const size_t bytes = (size_t)ref_count(d) * api->size;
		if (!sample_call(api, &s->curve, d, got))
			return;
		const bool same = s->seen && memcmp(got, s->got[d], bytes) == 0;
		expect(same || !(s->seen & ~(unsigned)EW_PORTABLE),
			"other bits than %s, degree %d of %s", ew_target_name(s->seen), d,
			curve_text(&s->curve));
		memcpy(s->got[d], got, bytes);
		if (!same)
			expect_moments(api, got, d == 0 ? s->area : s->moments, d, k[d],
				curve_tiny(api, &s->curve, d, k[d]), &worst[d],
				curve_text(&s->curve));
	}
	s->seen = target;
}

static inline void print_worst(const char *what, const Api *api, const double *worst, const long *k)
{
	printf("largest error of %s, %s, in u W (allowed), degrees 0 to %d:", what, api->name,
		CURVE_DEGREE);
	for (int d = 0; d <= CURVE_DEGREE; d++)
		printf(" %.2f (%ld)", worst[d], k[d]);
	printf("\n");
}

/* Samples of one kind under all targets; k[d] is what is allowed. Frees the samples. */
static inline void test_samples(const Api *api, const char *what, Sample *samples, int count,
	const long *k)
{
	double worst[CURVE_DEGREE + 1] = { 0 };
	for (unsigned target = 0; next_target(&target);) {
		check_begin("%s, %s, %s", what, api->name, ew_target_name(target));
		for (int i = 0; i < count; i++)
			sample_test(api, &samples[i], target, k, worst);
		check_end();
	}
	for (int i = 0; i < count; i++)
		sample_free(&samples[i]);
	print_worst(what, api, worst, k);
}

#endif
