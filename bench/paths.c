/* paths.c - moments of paths, and what gathering their edges costs.
 *
 * A path of glyph-like contours, 4 to 20 lines and quads each, in one call and in a call per
 * contour. Beside it stand the kernels alone: as many lines and quads, in the same portions, over
 * control points that lie ready in L1. */
#include "bench.h"

#include <stdlib.h>

enum { CONTOURS = 2000, FEWEST = 4, MOST = 20, MOST_LANES = 16 };

/* Where a contour begins among verbs and points, and how many lines and quads there are. */
typedef struct { size_t verb, point, lines, quads; } Part;

typedef struct {
	size_t verbs, points, edges;
	Part part[CONTOURS + 1];       /* the last one: ends, and totals of all contours */
	unsigned char *verb;
	double *point;
	float *pointf;                 /* the same numbers */
} Path;

typedef struct { const Path *path; const Target *target; int precision, degree, whole; } PathJob;

/* ---- the path ---- */

static void add_point(Path *path, double x, double y)
{
	float *place = path->pointf + 2 * path->points;
	place[0] = (float)x;
	place[1] = (float)y;
	for (int axis = 0; axis < 2; ++axis)
		path->point[2 * path->points + (size_t)axis] = (double)place[axis];
	++path->points;
}

/* From (x[0],y[0]) to (x[1],y[1]); a quad bulges by a quarter of its chord at its control point. */
static void add_edge(Path *path, Part *part, const double *x, const double *y, int quad)
{
	part->quads += (size_t)quad;
	part->lines += (size_t)!quad;
	path->verb[path->verbs++] = quad ? EW_QUAD : EW_LINE;
	if (quad)
		add_point(path, (x[0] + x[1]) / 2 + (y[1] - y[0]) / 4,
			(y[0] + y[1]) / 2 - (x[1] - x[0]) / 4);
	add_point(path, x[1], y[1]);
}

static void add_contour(Path *path, Part *part, const double *x, const double *y, size_t edges,
	const double *chance)
{
	*part = (Part){ path->verbs, path->points, 0, 0 };
	path->verb[path->verbs++] = EW_MOVE;
	add_point(path, x[0], y[0]);
	for (size_t i = 0; i < edges; ++i)
		add_edge(path, part, x + i, y + i, chance[i] < 0.5);
	path->verb[path->verbs++] = EW_CLOSE;
	path->edges += edges;
}

static Path *path_make(void)
{
	Rings rings = rings_make(CONTOURS, FEWEST, MOST);
	Path *path = allocate(sizeof *path);
	Part *total = &path->part[CONTOURS];
	double *chance = allocate(rings.vertices * sizeof *chance);
	points_make(DOUBLE, chance, rings.vertices);
	path->verbs = path->points = path->edges = 0;
	path->verb = allocate(rings.vertices + CONTOURS);
	path->point = allocate(4 * rings.vertices * sizeof *path->point);
	path->pointf = allocate(4 * rings.vertices * sizeof *path->pointf);
	*total = (Part){ 0, 0, 0, 0 };
	for (size_t i = 0; i < CONTOURS; ++i) {
		const size_t first = (size_t)rings.offsets[i];
		add_contour(path, &path->part[i], rings.x + first, rings.y + first,
			(size_t)rings.offsets[i + 1] - first - 1, chance + first);
		total->lines += path->part[i].lines;
		total->quads += path->part[i].quads;
	}
	total->verb = path->verbs;
	total->point = path->points;
	free(chance);
	rings_free(&rings);
	return path;
}

static void path_free(Path *path)
{
	free(path->verb);
	free(path->point);
	free(path->pointf);
	free(path);
}

/* ---- trials ---- */

static void moments_of(const PathJob *job, const Part *from, const Part *to)
{
	static double out[EW_MOMENTS(EW_MAX_CURVE_DEGREE)];
	static float outf[EW_MOMENTS(EW_MAX_CURVE_DEGREE)];
	const unsigned char *verb = job->path->verb + from->verb;
	const size_t verbs = to->verb - from->verb, points = to->point - from->point;
	if (job->precision == DOUBLE)
		ew_path_moments(job->degree, verb, verbs, job->path->point + 2 * from->point,
			points, NULL, 0, out);
	else
		ew_path_momentsf(job->degree, verb, verbs, job->path->pointf + 2 * from->point,
			points, NULL, 0, outf);
}

static void path_run(const void *context, long repeat)
{
	const PathJob *job = context;
	const Part *part = job->path->part;
	while (repeat-- > 0)
		if (job->whole)
			moments_of(job, part, part + CONTOURS);
		else
			for (int i = 0; i < CONTOURS; ++i)
				moments_of(job, part + i, part + i + 1);
}

static void edges_run(const Kernel *kernel, size_t edges)
{
	static _Alignas(64) double x[4 * EW_EDGES], y[4 * EW_EDGES];
	static _Alignas(64) double sum[EW_MAX_ACCUMULATORS * MOST_LANES];
	static _Alignas(64) float xf[4 * EW_EDGES], yf[4 * EW_EDGES];
	static _Alignas(64) float sumf[EW_MAX_ACCUMULATORS * MOST_LANES];
	for (; edges > 0; edges -= edges < EW_EDGES ? edges : EW_EDGES) {
		const size_t count = edges < EW_EDGES ? edges : EW_EDGES;
		if (kernel->run)
			kernel->run(x, y, x, EW_EDGES, EW_LANES, count, sum);
		else
			kernel->runf(xf, yf, xf, EW_EDGES, EW_LANES_FLOAT, count, sumf);
	}
}

static void bare_run(const void *context, long repeat)
{
	static const short line[] = { EW_IDS_LINE }, quad[] = { EW_IDS_QUAD };
	const PathJob *job = context;
	const Kernel *kernels = job->target->kernels[job->precision];
	while (repeat-- > 0)
		for (int i = job->whole ? CONTOURS : 0; i < CONTOURS + job->whole; ++i) {
			edges_run(&kernels[line[job->degree]], job->path->part[i].lines);
			edges_run(&kernels[quad[job->degree]], job->path->part[i].quads);
		}
}

static void measure_paths(Table *table, const Path *path, int precision, int whole, int rounds)
{
	static const int degrees[] = { 0, 1, 2, 4 };
	enum { DEGREES = (int)(sizeof degrees / sizeof *degrees) };
	const Target *target[MAX_TARGETS];
	const Target *widest = target[targets_here(target) - 1];
	PathJob job[DEGREES];
	Race race = race_new(rounds);
	for (int i = 0; i < DEGREES; ++i) {
		job[i] = (PathJob){ path, widest, precision, degrees[i], whole };
		race_add(&race, bare_run, &job[i], (double)path->edges);
		race_add(&race, path_run, &job[i], (double)path->edges);
	}
	race_run(&race);
	for (int i = 0; i < DEGREES; ++i) {
		table_row(table, "%s, degree %d, %s", whole ? "one call" : "a call per contour",
			degrees[i], precision_names[precision]);
		table_put(table, race_median(&race, 2 * i));
		table_put(table, race_median(&race, 2 * i + 1));
		table_put(table, race_minimum(&race, 2 * i + 1));
		table_put(table, race_ratio(&race, 2 * i + 1, 2 * i));
	}
	race_free(&race);
}

void paths_tables(const Effort *effort)
{
	Table *table = table_new("paths", "ew_path_moments, 2000 contours of 4 to 20 lines and "
		"quads, ns per edge", "Kernels: the widest target over as many edges, gathered.");
	Path *path = path_make();
	table_figures(table, "kernels", "median", 2);
	table_figures(table, "path", "median", 2);
	table_figures(table, "path", "min", 2);
	table_figures(table, "", "ratio", 2);
	for (int whole = 1; whole >= 0; --whole)
		for (int precision = 0; precision < PRECISIONS; ++precision)
			measure_paths(table, path, precision, whole, effort->rounds);
	table_print(table);
	path_free(path);
}
