/* kernel.c - the list of kernels of a request, each built, proven and bounded.
 *
 * Precisions share a program, only the type differs, unless it holds constants that are not
 * rational. Targets without FMA run the portable program, the others the fused one. The finish
 * program of a ring is the same for all. Families:
 *
 *     moments, magnitudes, compensated    of rings, to each degree; what bounds them; Dot2
 *     line, quad, conic, cubic            moments of edges one by one, m the degree; a conic's are
 *                                         those of the cap beyond its chord
 *     radius                              power m of the distance
 *     closure                             x0 y0 - x1 y1
 *     coverage                            of a rectangle
 *     filter                              one filter, centred at the origin
 *     monomial, polynomial                one integrand over rings */
#include "gen.h"

/* p polynomials, d dag, f fused, s schedule */
typedef struct { const char *letters; Text *text; } Dump;

static int wants(const Dump *dump, char letter)
{
	for (const char *p = dump->letters; p && *p; ++p)
		if (*p == letter)
			return 1;
	return 0;
}

static void dump_polynomials(const Dump *dump, const char *name, const Integral *want, int count)
{
	if (!wants(dump, 'p'))
		return;
	for (int j = 0; j < count; ++j)
		text_add(dump->text, "%s: polynomial %d\n  %s\n", name, j,
			poly_text(want[j].value, " "));
}

static void dump_dag(const Dump *dump, char letter, const char *name, const Dag *dag)
{
	if (!wants(dump, letter))
		return;
	text_add(dump->text, "%s: %s, scheme %s\n", name, letter == 'd' ? "dag" : "fused",
		dag->scheme);
	dag_dump(dump->text, dag);
	for (int j = 0; j < dag->finishes; ++j)
		text_add(dump->text, "  finish %d = %s\n", j, poly_text(dag->finish[j], " "));
}

static Program dumped_schedule(const Dump *dump, const char *name, const char *what, const Dag *dag)
{
	Program program = schedule(dag);
	if (wants(dump, 's')) {
		text_add(dump->text, "%s: schedule, %s\n", name, what);
		program_dump(dump->text, &program);
	}
	return program;
}

static Program scheduled(const Dump *dump, const char *name, const char *what, const Dag *dag,
	const Integral *want, int count)
{
	Program program = dumped_schedule(dump, name, what, dag);
	prove_program(&program, want, count);
	return program;
}

/* A curve's function of one edge: the area, or a monomial as a sum over nodes. */
static void build_curve_edge(Edge *edge, const Dag *dag, const char *name, const Dump *dump)
{
	const Integrand *what = edge->what;
	dump_dag(dump, 'd', name, dag);
	if (dag->proof == PROOF_QUADRATURE) {
		edge->program = dumped_schedule(dump, name, "portable", dag);
		prove_quadrature(&edge->program, what->m, what->n);
	} else {
		Poly one = poly_const(rat(1, 1));
		const Integral want = { .value = green_curve(window_points(edge->window), one) };
		prove_dag(dag, &want, 1, "scheme");
		edge->program = scheduled(dump, name, "portable", dag, &want, 1);
	}
	edge->bound = bound_path(dag);
}

static const char *const window_names[WINDOWS] = { "line", "vertex", "quad", "conic", "cubic" };

const char *edge_name(const Edge *edge)
{
	return format("%s_%s", window_names[edge->window], edge->what ? edge->what->name : "area");
}

static Edge dumped_edge(const Integrand *what, int window, const Dump *dump)
{
	Edge edge = { .what = what, .window = window };
	const char *name = edge_name(&edge);
	Dag *dag;
	if (window != WINDOW_LINE || !what) {
		dag = what ? curve_monomial_edge(window, what->m, what->n)
			: curve_area_edge(window);
		build_curve_edge(&edge, dag, name, dump);
	} else {
		edge.integral = green_line(what->integrand);
		dag = scheme_edge(&edge.integral);
		dump_polynomials(dump, name, &edge.integral, 1);
		dump_dag(dump, 'd', name, dag);
		prove_dag(dag, &edge.integral, 1, "scheme");
		edge.program = scheduled(dump, name, "portable", dag, &edge.integral, 1);
		edge.bound = bound_edge(dag, &edge.integral);
	}
	if (dag->proof == PROOF_POLYNOMIAL && !dag_reverses(dag))
		bug("swapping the ends of the edge does not negate %s bit for bit", name);
	return edge;
}

Edge build_edge(const Integrand *what)
{
	const Dump silent = { NULL, NULL };
	return dumped_edge(what, WINDOW_LINE, &silent);
}

static void worsen(Bound *worst, Bound bound)
{
	worst->k = bound.k > worst->k ? bound.k : worst->k;
	worst->repeat = bound.repeat > worst->repeat ? bound.repeat : worst->repeat;
}

static void prove_pieces(const Ring *ring, const Program *program)
{
	if (ring->filter)
		prove_window(program, ring->filter);
	else
		prove_coverage(program);
}

/* One precision: portable and fused program, each proven in the way its scheme allows. */
static void build_programs(Ring *ring, int is_float, const Dag *dag, const Integral *want,
	const Dump *dump)
{
	const int exact = dag->proof == PROOF_POLYNOMIAL;
	dump_dag(dump, 'd', ring->name, dag);
	Dag *fused = fuse(dag);
	dump_dag(dump, 'f', ring->name, fused);
	if (exact) {
		prove_dag(dag, want, ring->outputs, "scheme");
		prove_dag(fused, want, ring->outputs, "fuse");
		ring->portable[is_float] = scheduled(dump, ring->name, "portable", dag, want,
			ring->outputs);
		ring->fused[is_float] = scheduled(dump, ring->name, "fma", fused, want,
			ring->outputs);
		return;
	}
	ring->portable[is_float] = dumped_schedule(dump, ring->name, "portable", dag);
	ring->fused[is_float] = dumped_schedule(dump, ring->name, "fma", fused);
	if (dag->proof == PROOF_PIECES) {
		prove_pieces(ring, &ring->portable[is_float]);
		prove_pieces(ring, &ring->fused[is_float]);
	}
	if (dag->proof == PROOF_QUADRATURE) {
		prove_quadrature(&ring->portable[is_float], ring->m, 0);
		prove_quadrature(&ring->fused[is_float], ring->m, 0);
	}
}

/* From the programs of double and of float, which are the same unless they hold other constants. */
static void build_ring(Ring *ring, const Dag *dag, const Dag *as_float, const Integral *want,
	const Dump *dump)
{
	build_programs(ring, 0, dag, want, dump);
	if (as_float != dag) {
		build_programs(ring, 1, as_float, want, dump);
	} else {
		ring->portable[1] = ring->portable[0];
		ring->fused[1] = ring->fused[0];
	}
	Dag *finish = scheme_finish(dag);
	ring->finish = schedule(finish);
	prove_finish(&ring->finish, dag);
	ring->accumulators = dag->outs * dag->turns;
	ring->turns = dag->turns;
	ring->window = dag->window;
	ring->scheme = dag->scheme;
}

/* All but the compensated area, whose bound is not a number of roundings. */
static void build_bounded_ring(Ring *ring, const Dag *dag, const Integral *want, const Dump *dump)
{
	build_ring(ring, dag, dag, want, dump);
	ring->bound = bound_ring(dag, ring->finish.dag, want, ring->outputs);
	for (int j = 0; j < ring->outputs; ++j)
		worsen(&ring->worst, ring->bound[j]);
}

/* With the bound that the scheme states, or the longest path of roundings. */
static void build_other_ring(Ring *ring, const Dag *dag, const Dag *as_float, const Integral *want,
	const Dump *dump)
{
	build_ring(ring, dag, as_float, want, dump);
	ring->worst = dag->k ? (Bound){ dag->k, 1 } : bound_path(dag);
	ring->bound = allocate((size_t)ring->outputs * sizeof *ring->bound);
	for (int j = 0; j < ring->outputs; ++j)
		ring->bound[j] = ring->worst;
}

static Ring *next_ring(Kernels *kernels, const char *name, const char *family, int m, int n,
	int outputs)
{
	Ring *ring = &kernels->ring[kernels->rings++];
	*ring = (Ring){ .name = name, .family = family, .m = m, .n = n, .outputs = outputs };
	return ring;
}

static void build_integrand(Kernels *all, const Integrand *what, const char *scheme,
	const Dump *dump)
{
	Edge edge = dumped_edge(what, WINDOW_LINE, dump);
	all->edge[all->edges++] = edge;
	const char *family = what->m < 0 ? "polynomial" : "monomial";
	Ring *ring = next_ring(all, what->name, family, what->m, what->n, 1);
	build_bounded_ring(ring, scheme_ring(&edge.integral, -1, scheme), &edge.integral, dump);
}

/* Moments come in the order of EW_INDEX,
 * so those of a lower degree are the first of those of a higher one. */
static Integral *all_integrals(const Request *request)
{
	int count = (request->moments + 1) * (request->moments + 2) / 2;
	Integral *want = allocate((size_t)(count + 1) * sizeof *want);
	for (int i = 0; i < count && request->moments >= 0; ++i)
		want[i] = green_line(request->monomial[i].integrand);
	return want;
}

static void build_compensated(Ring *ring, const Integral *want, const Dump *dump)
{
	const Dag *dag = compensated_area();
	build_ring(ring, dag, dag, want, dump);
}

/* All moments to each degree, the magnitudes that bound them, and the compensated area. */
static void build_families(Kernels *all, const Request *request, const Dump *dump,
	void (*progress)(int done, int of), int rings)
{
	Integral *want = all_integrals(request), *terms = all_integrals(request);
	for (int degree = 0; degree <= request->moments; ++degree) {
		const int outputs = (degree + 1) * (degree + 2) / 2;
		progress(all->rings, rings);
		build_bounded_ring(next_ring(all, format("moments_%d", degree), "moments", degree, 0,
			outputs), scheme_ring(want, degree, request->scheme), want, dump);
	}
	for (int j = 0; j < (request->moments + 1) * (request->moments + 2) / 2; ++j)
		terms[j].value = want[j].magnitude;
	for (int degree = 0; degree <= request->moments; ++degree) {
		const int outputs = (degree + 1) * (degree + 2) / 2;
		const Integral vertex = moments_vertex_magnitude();
		progress(all->rings, rings);
		build_bounded_ring(next_ring(all, format("magnitudes_%d", degree), "magnitudes", degree, 0,
			outputs), moments_magnitudes(degree), degree ? terms : &vertex, dump);
	}
	if (request->moments >= 0)
		build_compensated(next_ring(all, "compensated", "compensated", 0, 0, 1), want, dump);
}

/* ---- every kind of edge ---- */

/* Kernels of moments of curves are long: only these degrees have one, and the highest. */
static int has_kernel(const Request *request, int degree)
{
	return degree <= 2 || degree % 4 == 0 || degree == request->curves;
}

static void build_curves(Kernels *all, const Request *request, int window, const Dump *dump)
{
	const char *kind = window_names[window];
	for (int degree = 0; degree <= request->curves; ++degree) {
		if (!has_kernel(request, degree))
			continue;
		const int outputs = (degree + 1) * (degree + 2) / 2;
		Ring *ring = next_ring(all, format("%s_%d", kind, degree), kind, degree, 0, outputs);
		if (window == WINDOW_CONIC) {
			build_other_ring(ring, conic_cap(degree, 0), conic_cap(degree, 1), NULL, dump);
			continue;
		}
		const Dag *dag = curve_moments(window, degree, request->scheme);
		Integral *want = allocate((size_t)outputs * sizeof *want);
		for (int j = 0; j < outputs && dag->proof == PROOF_POLYNOMIAL; ++j)
			want[j].value = green_curve(window_points(window),
				request->monomial[j].integrand);
		build_other_ring(ring, dag, dag, want, dump);
	}
}

/* Line edges one by one: the moments of rings serve but for degree 0, the vertex form. */
static void build_line_area(Kernels *all, const Dump *dump)
{
	const Integral want = { .value = green_curve(2, poly_const(rat(1, 1))) };
	const Dag *dag = curve_moments(WINDOW_LINE, 0, NULL);
	build_other_ring(next_ring(all, "line_0", "line", 0, 0, 1), dag, dag, &want, dump);
}

static void build_distance(Kernels *all, const Dump *dump)
{
	static const struct { int power; const char *name; } radius[] = {
		{ -1, "radius_inverse" }, { 1, "radius_1" }, { 3, "radius_3" }, { 5, "radius_5" },
	};
	for (int i = 0; i < LENGTH(radius); ++i) {
		Dag *dag = distance_power(radius[i].power, 0);
		Dag *as_float = distance_power(radius[i].power, 1);
		if (!dag_reverses(dag) || !dag_reverses(fuse(dag)))
			bug("swapping the ends of the edge does not negate %s bit for bit",
				radius[i].name);
		build_other_ring(next_ring(all, radius[i].name, "radius", radius[i].power, 0, 1),
			dag, as_float, NULL, dump);
	}
}

static void build_closure(Kernels *all, const Dump *dump)
{
	const int start[] = { VAR_X0, VAR_Y0 }, end[] = { VAR_X1, VAR_Y1 };
	Poly sum = poly_sub(poly_mul(poly_var(start[0]), poly_var(start[1])),
		poly_mul(poly_var(end[0]), poly_var(end[1])));
	const Integral want = { .value = sum };
	const Dag *dag = closure_sum();
	build_other_ring(next_ring(all, "closure", "closure", 0, 0, 1), dag, dag, &want, dump);
}

/* ---- windows ---- */

static void build_window(Ring *ring, Dag *dag, const Dump *dump)
{
	if (!dag_reverses(dag) || !dag_reverses(fuse(dag)))
		bug("swapping the ends of the edge does not negate %s bit for bit", ring->name);
	build_other_ring(ring, dag, dag, NULL, dump);
}

static void build_deposit(Deposited *deposited, const Filter *filter, const Dump *dump)
{
	const char *name = format("deposit_%s", filter->name);
	Dag *dag = deposit(filter), *fused = fuse(dag);
	dump_dag(dump, 'd', name, dag);
	dump_dag(dump, 'f', name, fused);
	if (!dag_reverses(dag) || !dag_reverses(fused))
		bug("swapping the ends of the edge does not negate %s bit for bit", name);
	deposited->filter = filter;
	deposited->portable = dumped_schedule(dump, name, "portable", dag);
	deposited->fused = dumped_schedule(dump, name, "fma", fused);
	prove_deposit(&deposited->portable, filter);
	prove_deposit(&deposited->fused, filter);
}

/* A kernel has some 50 operations per cell: beyond this nobody would wait for a compiler. */
static void check_cells(const Filter *filter)
{
	enum { MOST = 16 };
	const Cells cells = filter_cells(filter);
	if (cells.columns > MOST || cells.rows > MOST)
		fatal(EXIT_USAGE, "filter %s has %d x %d cells between its knots; at most %d x %d are "
			"supported, because kernels beyond would be too long to compile: use fewer "
			"pieces, or a smaller support", filter->name, cells.columns, cells.rows, MOST,
			MOST);
}

static void build_windows(Kernels *all, const Request *request, const Dump *dump,
	void (*progress)(int done, int of), int rings)
{
	if (request->families & FAMILY_COVERAGE)
		build_window(next_ring(all, "coverage", "coverage", 0, 0, 1), window_coverage(), dump);
	for (int i = 0; i < request->filters; ++i) {
		const Filter *filter = &request->filter[i];
		check_cells(filter);
		Ring *ring = next_ring(all, filter->name, "filter", filter->degree, 0, 1);
		progress(all->rings, rings);
		ring->filter = filter;
		build_window(ring, window_filter(filter), dump);
		if (deposit_size(filter))
			build_deposit(&all->deposit[all->deposits++], filter, dump);
	}
}

static const struct { unsigned edge; int window; } curve_kinds[] = {
	{ EDGE_QUAD, WINDOW_QUAD }, { EDGE_CONIC, WINDOW_CONIC }, { EDGE_CUBIC, WINDOW_CUBIC },
};

static void build_edge_kinds(Kernels *all, const Request *request, const Dump *dump,
	void (*progress)(int done, int of), int rings)
{
	if (request->families & FAMILY_CURVES)
		build_line_area(all, dump);
	for (int i = 0; i < LENGTH(curve_kinds) && request->families & FAMILY_CURVES; ++i)
		if (request->edges & curve_kinds[i].edge) {
			progress(all->rings, rings);
			build_curves(all, request, curve_kinds[i].window, dump);
		}
	if (request->families & FAMILY_DISTANCE)
		build_distance(all, dump);
	if (request->families & FAMILY_CLOSURE)
		build_closure(all, dump);
}

/* Functions of one edge: areas, and the monomials asked for by name. */
static void build_curve_edges(Kernels *all, const Request *request, const Dump *dump)
{
	if (request->families & FAMILY_MOMENTS)
		all->edge[all->edges++] = dumped_edge(NULL, WINDOW_LINE, dump);
	for (int i = 0; i < LENGTH(curve_kinds); ++i) {
		const int window = curve_kinds[i].window;
		if (!(request->edges & curve_kinds[i].edge) || window == WINDOW_CONIC)
			continue;
		if (request->families & FAMILY_CURVES)
			all->edge[all->edges++] = dumped_edge(NULL, window, dump);
		for (int k = 0; k < request->monomials; ++k)
			if (request->monomial[k].by_name)
				all->edge[all->edges++] = dumped_edge(&request->monomial[k], window,
					dump);
	}
}

Kernels build_kernels(const Request *request, void (*progress)(int done, int of),
	const char *letters, Text *text)
{
	const Dump dump = { letters, text };
	const int lines = request->edges & EDGE_LINE ? request->monomials : 0;
	const int integrands = lines + request->polynomials;
	const int edges = 4 * request->monomials + request->polynomials + 3;
	const int rings = integrands + 5 * (request->moments + 1) + request->filters + 9;
	Kernels all = {
		allocate((size_t)edges * sizeof(Edge)), 0, allocate((size_t)rings * sizeof(Ring)), 0,
		allocate((size_t)(request->filters + 1) * sizeof(Deposited)), 0
	};
	build_families(&all, request, &dump, progress, rings);
	build_edge_kinds(&all, request, &dump, progress, rings);
	build_windows(&all, request, &dump, progress, rings);
	build_curve_edges(&all, request, &dump);
	for (int i = 0; i < integrands; ++i) {
		progress(all.rings, rings);
		build_integrand(&all, i < lines ? &request->monomial[i]
			: &request->polynomial[i - lines], request->scheme, &dump);
	}
	progress(rings, rings);
	return all;
}
