/* Images of paths.
 *
 * A path of lines has the pixels of its contours as rings, bit for bit. Curves are held against
 * fine polylines of the same curves: the library's lines are nowhere farther from a curve than 2^-8
 * pixel, so over a stretch of length L within the support of a pixel's filter the area between is
 * at most 2^-8 L, and the pixel differs by max |f| times that and the error of an image. The fine
 * lines are 3000 a curve, closer where t is near 0 and 1: with second derivatives up to 10^4 pixels
 * they are within 2^-11 themselves.
 */
#include "raster.h"

#define FLATNESS 0x1p-8
#define FINENESS 0x1p-11
#define ERROR 2e-6

enum { SIDE = 32, MOST_VERBS = 40, MOST_POINTS = 3 * MOST_VERBS, FINE = 3000 };

typedef struct {
	size_t verbs, points, weights;
	unsigned char verb[MOST_VERBS];
	double point[2 * MOST_POINTS], weight[MOST_VERBS];
	float pointf[2 * MOST_POINTS], weightf[MOST_VERBS];
} Path;

static void add_point(Path *p, double x, double y)
{
	p->point[2 * p->points] = x;
	p->point[2 * p->points++ + 1] = y;
}

static void add_verb(Path *p, int verb)
{
	p->verb[p->verbs++] = (unsigned char)verb;
}

/* Rounds to float, both arrays the same. */
static void path_pack(Path *p)
{
	for (size_t i = 0; i < 2 * p->points; i++) {
		p->point[i] = round_to(24, p->point[i]);
		p->pointf[i] = (float)p->point[i];
	}
	for (size_t i = 0; i < p->weights; i++) {
		p->weight[i] = round_to(24, p->weight[i]);
		p->weightf[i] = (float)p->weight[i];
	}
}

static int path_raster(const Api *api, const RasterFilter *filter, const Path *p, Image *image)
{
	return api->bits == 24 ? ew_raster_pathf(filter->filter, p->verb, p->verbs, p->pointf,
			p->points, p->weightf, p->weights, image->pixels, image->width,
			image->height, image->stride)
		: ew_raster_path(filter->filter, p->verb, p->verbs, p->point, p->points, p->weight,
			p->weights, image->pixels, image->width, image->height, image->stride);
}

static Image path_image(const Api *api, const RasterFilter *filter, const Path *p)
{
	Image image = image_new(SIDE, SIDE, SIDE);
	const int code = path_raster(api, filter, p, &image);
	expect(code == EW_OK, "%s: code %d", filter->name, code);
	return image;
}

/* ---- Lines ---- */

/* Contours of lines, some empty or of one point, closed or not, some of which go on after closing
 * from where they began; and the rings they are. */
static Scene line_path(Path *p)
{
	Scene s = scene_new(MOST_VERBS, MOST_VERBS);
	memset(p, 0, sizeof *p);
	s.rings = 0;
	s.n = 0;
	s.offsets[0] = 0;
	while (p->verbs < MOST_VERBS - 12) {
		const double x = random_int(-64, 8 * SIDE) / 4.0, y = random_real(-5, SIDE + 5);
		const bool again = s.rings > 0 && p->verb[p->verbs - 1] == EW_CLOSE
			&& random_int(0, 2) == 0;
		const size_t first = again ? (size_t)s.offsets[s.rings - 1] : 0;
		if (!again) {
			add_verb(p, EW_MOVE);
			add_point(p, x, y);
		}
		s.x[s.n] = again ? s.x[first] : x;
		s.y[s.n++] = again ? s.y[first] : y;
		for (int lines = random_int(0, 6); lines > 0; lines--) {
			s.x[s.n] = random_real(-5, SIDE + 5);
			s.y[s.n] = random_int(-8, 2 * SIDE) / 2.0;
			add_verb(p, EW_LINE);
			add_point(p, s.x[s.n], s.y[s.n]);
			s.n++;
		}
		if (random_int(0, 1))
			add_verb(p, EW_CLOSE);
		s.offsets[++s.rings] = (int32_t)s.n;
	}
	path_pack(p);
	scene_pack(&s);
	return s;
}

static void test_lines(const Api *api, const RasterFilter *filter)
{
	static Path p;
	check_begin("paths of lines are rings: %s, %s", filter->name, api->name);
	for (int i = 0; i < 200; i++) {
		Scene s = line_path(&p);
		Image want = image_of(api, filter, &s, SIDE, SIDE);
		Image got = path_image(api, filter, &p);
		const int at = image_differs(&got, &want, 0, 0, 1);
		expect(at < 0, "pixel %d differs", at);
		image_free(&want);
		image_free(&got);
		scene_free(&s);
	}
	check_end();
}

/* ---- Curves ---- */

typedef struct {
	size_t n;
	double x[MOST_VERBS * FINE], y[MOST_VERBS * FINE];
} Trace;

/* The point at t of a curve through 3 or 4 points; w is the weight in the middle, if 3. */
static void curve_at(const double *p, int kind, double w, double t, double at[2])
{
	const double s = 1 - t;
	double b[4] = { s * s, 2 * w * s * t, t * t, 0 };
	if (kind == EW_CUBIC) {
		b[0] = s * s * s;
		b[1] = 3 * s * s * t;
		b[2] = 3 * s * t * t;
		b[3] = t * t * t;
	}
	const double sum = b[0] + b[1] + b[2] + b[3];
	for (int axis = 0; axis < 2; axis++)
		at[axis] = (b[0] * p[axis] + b[1] * p[2 + axis] + b[2] * p[4 + axis]
			+ (kind == EW_CUBIC ? b[3] * p[6 + axis] : 0)) / sum;
}

/* One contour of curves of a kind, as a path and as a fine polyline. */
static void curved_path(Path *p, Trace *trace, int kind, double low, double high)
{
	const int more = kind == EW_CUBIC ? 3 : 2;
	memset(p, 0, sizeof *p);
	trace->n = 0;
	add_verb(p, EW_MOVE);
	add_point(p, random_real(low, high), random_real(low, high));
	for (int curves = random_int(1, 4); curves > 0; curves--) {
		add_verb(p, kind);
		for (int i = 0; i < more; i++)
			add_point(p, random_real(low, high), random_real(low, high));
		if (kind == EW_CONIC)
			p->weight[p->weights++] = random_int(0, 1) ? random_real(-0.6, 1)
				: exp2(random_real(-6, 4));
	}
	path_pack(p);
	for (size_t c = 0; c + 1 < p->verbs; c++) {
		const double *points = p->point + 2 * c * (size_t)more;
		for (int i = 0; i < FINE; i++) {
			/* dense where a conic of a large weight is fast: at its ends */
			const double t = 0.5 - 0.5 * cos(3.141592653589793 * i / FINE);
			double at[2];
			curve_at(points, kind, kind == EW_CONIC ? p->weight[c] : 1, t, at);
			trace->x[trace->n] = at[0];
			trace->y[trace->n++] = at[1];
		}
	}
	trace->x[trace->n] = p->point[2 * p->points - 2];
	trace->y[trace->n++] = p->point[2 * p->points - 1];
}

/* The length of the trace in the support of each pixel's filter, and as much wider as lines may be
 * off; pieces of it that are in at all count whole. */
static void trace_lengths(const Trace *t, int size, double length[SIDE * SIDE])
{
	memset(length, 0, SIDE * SIDE * sizeof *length);
	for (size_t k = 0; k + 1 < t->n; k++) {
		const double step = hypot(t->x[k + 1] - t->x[k], t->y[k + 1] - t->y[k]);
		const double reach = size / 2.0 + step + 2 * FLATNESS;
		for (int j = (int)fmax(0, ceil(t->y[k] - reach - 0.5));
			j < SIDE && j <= t->y[k] + reach - 0.5; j++) {
			for (int i = (int)fmax(0, ceil(t->x[k] - reach - 0.5));
				i < SIDE && i <= t->x[k] + reach - 0.5; i++)
				length[j * SIDE + i] += step;
		}
	}
}

/* Every kind of curve, within the image or leaving it. */
static void test_curves(const RasterFilter *filter, int kind, const char *name)
{
	static Path p;
	static Trace trace;
	static double length[SIDE * SIDE], want[SIDE * SIDE];
	double worst = 0;
	WindowFilter *definition = filter->definition();
	check_begin("%s against fine polylines: %s", name, filter->name);
	for (int i = 0; i < (filter->size > 2 ? 5 : 24); i++) {
		curved_path(&p, &trace, kind, i % 3 ? 2 : -SIDE, i % 3 ? SIDE - 2 : 2 * SIDE);
		const int32_t ends[] = { 0, (int32_t)trace.n };
		const RasterRings rings = { trace.x, trace.y, ends, 1 };
		raster_reference(want, definition, &rings, SIDE, SIDE);
		trace_lengths(&trace, filter->size, length);
		for (int t = 0; t < target_count * APIS; t++) {
			ew_use_target(target_bit[t / APIS]);
			Image image = path_image(&apis[t % APIS], filter, &p);
			for (int k = 0; k < SIDE * SIDE; k++) {
				const double got = (double)image_at(&image, k % SIDE, k / SIDE);
				const double bound = ERROR + filter->most
					* (FLATNESS + FINENESS) * length[k];
				expect(fabs(got - want[k]) <= bound, "%s, %s: pixel (%d,%d) is "
					"%.9g, fine %.9g, allowed %g", apis[t % APIS].name,
					ew_target_name(target_bit[t / APIS]), k % SIDE, k / SIDE,
					got, want[k], bound);
				worst = fmax(worst, fabs(got - want[k]));
			}
			image_free(&image);
		}
	}
	check_end();
	ew_use_target(0);
	printf("# %s, %s: off by %.3g at most\n", name, filter->name, worst);
	window_free(definition);
}

/* Weights so large that the curve is its control polygon, or 0, its chord. */
static void test_weights(void)
{
	static const double weights[] = { 0x1p40, 1e30, INFINITY, 0, 1e-30 };
	static Path p;
	check_begin("conics of extreme weights");
	for (int i = 0; i < 200; i++) {
		const double w = weights[i % 5];
		const bool chord = w < 1;
		Scene s = scene_new(chord ? 3 : 5, 1);
		size_t n = 0;
		memset(&p, 0, sizeof p);
		for (size_t k = 0; k < 5; k++) {
			const double x = random_real(-5, SIDE + 5), y = random_real(-5, SIDE + 5);
			add_point(&p, x, y);
			if (chord && k % 2)
				continue;
			s.x[n] = x;
			s.y[n++] = y;
		}
		add_verb(&p, EW_MOVE);
		for (p.weights = 0; p.weights < 2; p.weights++) {
			add_verb(&p, EW_CONIC);
			p.weight[p.weights] = w;
		}
		path_pack(&p);
		scene_pack(&s);
		const Api *api = &apis[i % APIS];
		Image want = image_of(api, &raster_filters[0], &s, SIDE, SIDE);
		Image got = path_image(api, &raster_filters[0], &p);
		for (int k = 0; k < SIDE * SIDE; k++) {
			/* at most all of five edges in the pixel */
			const double v = (double)image_at(&got, k % SIDE, k / SIDE);
			const double exact = (double)image_at(&want, k % SIDE, k / SIDE);
			expect(fabs(v - exact) <= 2 * ERROR + FLATNESS * 5 * 1.5, "weight %g: "
				"pixel %d is %.9g, not %.9g", w, k, v, exact);
		}
		image_free(&want);
		image_free(&got);
		scene_free(&s);
	}
	check_end();
}

/* A circle of four conics so large that the image is far inside. */
static void test_large(const RasterFilter *filter)
{
	static Path p;
	check_begin("curves up to 2^29 away: %s", filter->name);
	for (int i = 6; i < 30; i++) {
		const double r = ldexp(1, i), x[] = { 0, r, r, r, 0, -r, -r, -r, 0 };
		memset(&p, 0, sizeof p);
		add_verb(&p, EW_MOVE);
		for (int k = 0; k < 9; k++)
			add_point(&p, x[k], -x[(k + 2) % 8]);
		for (int k = 0; k < 4; k++) {
			add_verb(&p, EW_CONIC);
			p.weight[p.weights++] = 0.7071067811865476;
		}
		path_pack(&p);
		Image image = path_image(&apis[i % APIS], filter, &p);
		for (int k = 0; k < SIDE * SIDE; k++)
			expect(image_at(&image, k % SIDE, k / SIDE) == 1, "radius 2^%d: pixel %d "
				"is %.9g", i, k, (double)image_at(&image, k % SIDE, k / SIDE));
		image_free(&image);
	}
	check_end();
}

/* Both precisions and all targets: flattening is in double. */
static void test_targets(const RasterFilter *filter)
{
	static Path p;
	static Trace trace;
	check_begin("paths: the same bits on %s: %s", filter->size == 1 ? "every target"
		: "all targets with fused operations", filter->name);
	for (int i = 0; i < 60; i++) {
		Image first[2] = { { 0 }, { 0 } };
		curved_path(&p, &trace, EW_QUAD + i % 3, -5, SIDE + 5);
		for (int t = 0; t < target_count * APIS; t++) {
			const unsigned bit = target_bit[t / APIS];
			Image *want = &first[filter->size > 1 && bit == EW_PORTABLE];
			ew_use_target(bit);
			Image image = path_image(&apis[t % APIS], filter, &p);
			if (!want->all) {
				*want = image;
				continue;
			}
			expect(image_differs(&image, want, 0, 0, 1) < 0, "%s, %s: pixel %d differs",
				apis[t % APIS].name, ew_target_name(bit),
				image_differs(&image, want, 0, 0, 1));
			image_free(&image);
		}
		image_free(&first[0]);
		image_free(&first[1]);
	}
	check_end();
	ew_use_target(0);
}

int main(int argc, char **argv)
{
	static const char *const names[] = { "quads", "conics", "cubics" };
	check_start(argc, argv);
	list_targets();
	for (int f = 0; f < FILTERS; f++) {
		for (int a = 0; a < APIS; a++)
			test_lines(&apis[a], &raster_filters[f]);
		for (int kind = EW_QUAD; kind <= EW_CUBIC; kind++)
			test_curves(&raster_filters[f], kind, names[kind - EW_QUAD]);
		test_large(&raster_filters[f]);
		test_targets(&raster_filters[f]);
	}
	test_weights();
	return check_finish();
}
