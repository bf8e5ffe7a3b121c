/* gen.h - every type and prototype of the generator, one section per file, in pipeline order.
 *
 *     options, text --spec--> Request --green--> Integral (exact polynomials) --scheme--> Dag
 *     --fuse--> Dag --schedule--> Program --proof--> Kernels --emit--> Files --bundle--> disk
 *
 * Nothing may call a function of a later section (`make layers` checks it). No floating
 * point takes part in any decision, and iteration is always in index order, so the output
 * depends on the request alone. */
#ifndef GEN_H
#define GEN_H

#include <stddef.h>
#include <stdint.h>

#define GEN_VERSION "0.1.0"
/* Beyond it coefficients of curves and filters no longer fit 128-bit rationals. */
#define MAX_DEGREE 32
#define LENGTH(array) ((int)(sizeof(array) / sizeof((array)[0])))

/* ---- util.c: memory, text, the two ways to stop ---------------------------------------------- */

typedef struct { size_t chunk, used; } Mark; /* a state of the arena */
typedef struct { char *data; size_t size, room; } Text;   /* grows; zero-terminated once written */

void *allocate(size_t size);                 /* zeroed, from the arena; never NULL */
Mark  arena_mark(void);
void  arena_release(Mark mark);              /* frees all that was allocated since */
char *copy_string(const char *text, size_t size);
char *format(const char *pattern, ...) __attribute__((format(printf, 1, 2)));   /* in the arena */

void text_add(Text *text, const char *pattern, ...) __attribute__((format(printf, 2, 3)));
void text_append(Text *text, const char *data, size_t size);
char *text_take(Text *text);                 /* copies it to the arena and frees it */
void text_free(Text *text);
uint64_t text_hash(const char *data, size_t size);   /* FNV-1a, 64 bits */

typedef struct { const char *name, *text; size_t size; } Embedded;   /* a file, by embed.c */

enum { EXIT_DONE = 0, EXIT_DIFFERENT = 1, EXIT_USAGE = 2 };
/* The message with file, line, column and caret. */
typedef char *Locate(const void *reader, const char *message);
void reading(Locate *locate, const void *reader);   /* NULL NULL: no longer */
/* The user's fault; ours, which aborts. */
void fatal(int status, const char *pattern, ...) __attribute__((noreturn, format(printf, 2, 3)));
void bug(const char *pattern, ...) __attribute__((noreturn, format(printf, 1, 2)));

/* ---- rational.c: exact rationals on checked 128-bit integers; overflow is fatal, never wrong - */

__extension__ typedef __int128 Int;
__extension__ typedef unsigned __int128 Wide;
typedef struct { Int num, den; } Rat;        /* lowest terms, den > 0 */

Int  int_mul(Int a, Int b);
Int  int_add(Int a, Int b);
Int  int_gcd(Int a, Int b);
Int  int_binomial(int n, int k);
Rat  rat(Int num, Int den);                  /* reduced; den must not be 0 */
Rat  rat_add(Rat a, Rat b);
Rat  rat_sub(Rat a, Rat b);
Rat  rat_mul(Rat a, Rat b);
Rat  rat_div(Rat a, Rat b);
Rat  rat_neg(Rat a);
Rat  rat_abs(Rat a);
int  rat_sign(Rat a);
int  rat_compare(Rat a, Rat b);
int  rat_is(Rat a, int value);
Int  rat_ceil(Rat a);
char *int_text(Int a);
char *rat_text(Rat a);                       /* "-7/18" */
int  rat_significant(Rat a);                 /* bits of the significand if a is dyadic, else 0 */
char *rat_literal(Rat a, int is_float);      /* C literal of the nearest value, ties to even */

/* ---- polynomial.c: sparse polynomials over Q ------------------------------------------------- */

enum { VAR_X, VAR_Y,                         /* integrand */
       VAR_X0, VAR_Y0, VAR_X1, VAR_Y1,       /* vertices of the window */
       VAR_X2, VAR_Y2, VAR_X3, VAR_Y3,
       VAR_W,                                /* weight of a conic */
       VAR_CX,                               /* abscissa of the local origin */
       VAR_S, VAR_T,                         /* Bernstein parameters of an edge, s = 1 - t */
       VARS };
typedef Wide Mono;                           /* a byte per variable, above accumulator number + 1 */
typedef struct { Mono mono; Rat coef; } Term;
typedef struct { int count; Term *term; } Poly;   /* strictly descending, no zero coefficient */

const char *var_name(int var);
Mono mono_var(int var, int power);
Mono mono_accumulator(int index);
int  mono_power(Mono mono, int var);
int  mono_accumulator_of(Mono mono);         /* index, or -1 */
Mono mono_gcd(Mono a, Mono b);
Mono mono_keep(Mono mono, const int *vars, int count);   /* the factor in these variables */
Poly poly_zero(void);
Poly poly_mono(Rat coef, Mono mono);
Poly poly_const(Rat value);
Poly poly_var(int var);
Poly poly_collect(Term *term, int count);    /* sorts and merges; takes the array over */
Poly poly_add(Poly a, Poly b);
Poly poly_sub(Poly a, Poly b);
Poly poly_mul(Poly a, Poly b);
Poly poly_scale(Poly a, Rat factor);
Poly poly_pow(Poly a, int power);
Poly poly_abs(Poly a);                       /* every coefficient positive */
Poly poly_substitute(Poly a, const int *vars, const Poly *by, int count);
Poly poly_integral(Poly a, int var);          /* that is 0 where the variable is 0 */
int  poly_equal(Poly a, Poly b);
int  poly_degree(Poly a, int var);
Rat  poly_content(Poly a);                   /* c > 0 with a / c integer and coprime */
/* times: " " in mathematics, "*" in the grammar of expression.c */
char *poly_text(Poly a, const char *times);

/* ---- expression.c: what users write: names, numbers, polynomials, and the spot of an error --- */

enum { MAX_NAME = 40 };
typedef struct {
	const char *what, *text;             /* what the messages call it; ends with a zero */
	size_t at;                           /* next character */
	int nesting;
	int lines;                           /* the end of a line, and a #, end what is read */
	const char *no_y;                    /* why there may be no y in it, or NULL */
} Reader;

char *reader_locate(const void *reader, const char *message);   /* a Locate */
void syntax_error(const Reader *reader, size_t at, const char *message)
	__attribute__((noreturn));
int  reader_line(const Reader *reader, size_t at);
/* What stands here up to one of these characters, if it is not too long, fit to be shown. */
char *reader_word(const Reader *reader, const char *ends);
int  reader_peek(Reader *reader);            /* skips blanks; 0 at the end */
int  is_digit(int c);
Rat  read_number(Reader *reader);            /* integer or decimal, at its first digit */
const char *read_small(const char *text, int *value);   /* 0 .. MAX_DEGREE; NULL: it is not */
Poly read_sum(Reader *reader);               /* an expression in VAR_X, VAR_Y */
int  degree_in_xy(Poly a);                   /* in x and y */
size_t utf8_size(const char *text);          /* bytes of its first character; 0: it is none */
int  is_listed(const char *list, const char *name);   /* " this that " */
void check_identifier(const char *option, const char *name);
void check_free(const char *option, const char *name);   /* not a function of the library */
char *name_stem(const char *name);           /* without the f of a float twin */

/* ---- analysis.c: what holds of a filter, exactly --------------------------------------------- */

/* Separable: y0 = y1 = 0, value in VAR_X. */
typedef struct { Rat x0, x1, y0, y1; Poly value; } Piece;

typedef struct {
	char *name;                          /* identifier: mitchell, catmull_rom */
	const char *path;                    /* the file it was read from, or NULL */
	int   builtin;
	int   separable;                     /* k(x) k(y), else bivariate */
	int   even;                          /* as declared: k(-x) = k(x) */
	Piece *piece; int pieces;            /* ascending (x, then y), even ones on both sides; not
	                                      * listed where 0, joined where one polynomial */
	int   degree;                        /* separable: of k; bivariate: total degree */
	Rat   first_x, last_x, first_y, last_y;      /* support */
	int   size_x, size_y;                /* pixels that the support spans, if all knots are whole
	                                      * pixels apart on that axis; else 0 */
	Rat   integral;                      /* over the plane */
	int   continuity;                    /* -1: it jumps; else how many derivatives, of k or f */
	int   unity;                         /* the sum over whole-pixel shifts is 1 */
} Filter;

void analyse(Filter *filter);                /* from name, kind and pieces in any order */

/* ---- filter.c: filter files ------------------------------------------------------------------ */

extern const Embedded embedded_filters[];    /* gen/filters/; ends with a NULL name */

Filter filter_read(const char *word);        /* a built-in filter, or a path */
Filter filter_parse(const char *what, const char *text, size_t size);   /* text[size] is 0 */
const char *const *filter_names(void);       /* of the built-in ones; ends with NULL */
int    filter_is_builtin(const char *word);
char  *filter_canonical(const Filter *filter);   /* a file that reads as the same filter */
char  *filter_summary(const Filter *filter); /* the analysis, on one line */
void   filter_describe(Text *text, const Filter *filter);
void   filter_show(Text *text, const Filter *filter, const char *format_name);   /* --show */

/* ---- spec.c: what is asked for, and its grammar ---------------------------------------------- */

typedef struct {
	char *name;                          /* x4y2, soft; part of every symbol */
	int   m, n;                          /* exponents of a monomial; polynomial: -1 -1 */
	Poly  integrand;                     /* in VAR_X, VAR_Y */
	char *formula;                       /* x^4 y^2, for comments */
	int   by_name;                       /* asked for, not just part of a family */
} Integrand;

enum { PRECISION_DOUBLE = 1, PRECISION_FLOAT = 2 };
/* The bits of EW_PORTABLE, EW_FMA, ... */
enum { TARGET_PORTABLE = 1, TARGET_FMA = 2, TARGET_AVX2 = 4, TARGET_AVX512 = 8, TARGET_NEON = 16,
       TARGET_WASM128 = 32 };
enum { ALL_TARGETS = 63, TARGETS = 6 };
extern const char *const target_names[TARGETS];   /* in the order of the bits */

enum { FAMILY_MOMENTS = 1, FAMILY_CURVES = 2, FAMILY_DISTANCE = 4, FAMILY_CLOSURE = 8,
       FAMILY_COVERAGE = 16, FAMILY_FILTERS = 32 };
enum { ALL_FAMILIES = 63, FAMILIES = 6 };
extern const char *const family_names[FAMILIES];
enum { EDGE_LINE = 1, EDGE_QUAD = 2, EDGE_CONIC = 4, EDGE_CUBIC = 8 };
enum { ALL_EDGES = 15, EDGES = 4, CURVE_DEGREE = 8 };   /* of curves, unless asked for */
extern const char *const edge_names[EDGES];

typedef struct {
	unsigned families, edges;            /* 0: not said */
	int moments;                         /* all moments to this degree; -1: not asked for */
	int curves;                          /* those of curves, or -1 */
	Integrand *monomial;   int monomials;   /* single-edge functions and single-moment rings */
	Integrand *polynomial; int polynomials;
	Filter *filter; int filters;         /* the built-in ones first, if the family is wanted */
	unsigned precisions, targets;
	const char *scheme;                  /* preferred where it applies, or NULL */
	const char *prefix;                  /* NULL: ew and edgewise */
	const char *command;                 /* canonical command line of this emission */
} Request;

Integrand spec_monomial(const char *text);   /* "x4y2" */
Integrand spec_polynomial(const char *text); /* "soft=(1-x)*(1-y)" */
int  spec_degree(const char *text);          /* 0 .. MAX_DEGREE */
/* A bit set. */
unsigned spec_list(const char *option, const char *text, const char *const *words, int count);
void spec_prefix(const char *text);
char *spec_files(const Request *request);    /* comments: the files that the command names */
const char *const *spec_paths(const Request *request);   /* of these files; ends with NULL */
int  spec_has_rings(const Request *request);
void spec_complete(Request *request);        /* defaults, monomials of the family, names, command */

/* ---- green.c: integrand and edge -> exact polynomial; only here Green's theorem is known ----- */

typedef struct {
	Poly value;                          /* the contribution of one line edge, form 3 */
	Poly density;                        /* value = (x0 y1 - x1 y0) density */
	Poly magnitude;                      /* every term positive: W of the error bound */
} Integral;

Integral green_line(Poly integrand);
/* The value alone, for an edge with so many control points. */
Poly     green_curve(int points, Poly integrand);

/* ---- dag.c: hash-consed operations ----------------------------------------------------------- */

typedef uint32_t Ref;                        /* index of a node; children are smaller */
#define NONE UINT32_MAX
#define OP(name, operands, commutes, fma, add, divide, c, x86, neon, wasm) OP_##name,
enum {
#include "ops.def"
	OPS };
#undef OP

/* What an item of a kernel reads: the points of an edge, or a vertex between its neighbours. A
 * cell: a line edge, while the corners (x2,y2), (x3,y3) of a rectangle stay the same. */
enum { WINDOW_LINE, WINDOW_VERTEX, WINDOW_QUAD, WINDOW_CONIC, WINDOW_CUBIC, WINDOW_CELL, WINDOWS };
int  window_points(int window);
int  window_planes(int window);              /* arrays of coordinates: the weight is one more */

typedef struct {
	unsigned char op;
	Ref  arg[3];
	Rat  value;                          /* of a CONST */
	Mono input;                          /* of an INPUT: a variable or an accumulator */
	const char *name;                    /* what the formula calls it, or NULL */
} Node;

/* Equal polynomials; a sum over the nodes of a quadrature rule, modulo a prime; or not polynomial:
 * the tests compare with MPFR. */
enum { PROOF_POLYNOMIAL, PROOF_QUADRATURE, PROOF_PIECES, PROOF_NONE };

typedef struct {
	Node *node; int count, room;
	Ref  *bucket; int buckets;           /* hash table, a power of two */
	Ref  *out; int outs;                 /* roots, in the order of the outputs */
	Poly *finish; int finishes;          /* moments as linear forms of accumulators, or none */
	const char *scheme;                  /* name of the scheme that built it */
	int   turns;                         /* sets of accumulators that the items of a lane take
	                                      * in turn, to hide the latency of one */
	int   window;                        /* what an item reads */
	int   proof;                         /* how proof.c shows that it is right */
	int   k;                             /* error bound that the scheme states, or 0: counted */
} Dag;

int  op_operands(int op);
int  op_fma_cost(int op);
int  op_add_cost(int op);
int  op_divide_cost(int op);
int  op_commutes(int op);                    /* do its first two operands? */
const char *op_name(int op);
enum { SPELL_C, SPELL_X86, SPELL_NEON, SPELL_WASM, SPELLINGS };
const char *op_spelling(int op, int how);    /* how: a column of ops.def */

Dag *dag_new(const char *scheme);
/* Calls that build nodes must not be arguments of one call, which may be evaluated in any order. */
Ref  dag_node(Dag *dag, int op, Ref a, Ref b, Ref c);
Ref  dag_input(Dag *dag, Mono input);        /* a variable or an accumulator */
Ref  dag_var(Dag *dag, int var);
Ref  dag_accumulator(Dag *dag, int index);
Ref  dag_const(Dag *dag, Rat value);
Ref  dag_add(Dag *dag, Ref a, Ref b);        /* the smart constructors drop 0 and 1; NONE is 0 */
Ref  dag_sub(Dag *dag, Ref a, Ref b);
Ref  dag_mul(Dag *dag, Ref a, Ref b);
Ref  dag_scale(Dag *dag, Rat factor, Ref a);
Ref  dag_div(Dag *dag, Ref a, Ref b);
Ref  dag_unary(Dag *dag, int op, Ref a);
Ref  dag_choose(Dag *dag, Ref a, Ref positive, Ref otherwise);   /* by the sign of a */
Ref  dag_name(Dag *dag, Ref a, const char *name);   /* the first name given stays; returns a */
void dag_out(Dag *dag, Ref root);
void dag_accumulate(Dag *dag, Ref value);    /* next accumulator += value */
int *dag_uses(const Dag *dag);               /* uses of each node that an output reaches, else 0 */
/* The polynomial of a node from those of its operands. */
Poly dag_expand_node(const Node *node, const Poly *done);
Poly *dag_expand(const Dag *dag);            /* polynomial of each node */
int  dag_reverses(Dag *dag);                 /* swapped ends negate every output bit for bit */
void dag_dump(Text *text, const Dag *dag);

/* ---- fuse.c: a b + c -> one rounding; the only file that knows about it ---------------------- */

Dag *fuse(const Dag *dag);

/* ---- evaluate.c: from a polynomial to operations --------------------------------------------- */

typedef struct { Ref ref[VARS]; } Leaves;    /* what stands for each variable of a polynomial */
extern const int X_VARS[2], Y_VARS[2];       /* the variables of each axis, start and end */

Leaves ends(Dag *dag);                       /* every variable stands for itself */
Ref  cross(Dag *dag);                        /* s = x0 y1 - x1 y0 */
Ref  sum_of(Dag *dag, int start, int end, const char *name);
Ref  difference_of(Dag *dag, int start, int end, const char *name);   /* end - start */
/* axis: the letter of names, or 0 */
Ref  axis_part(Dag *dag, const Leaves *leaves, Mono mono, const int *vars, char axis);
Poly group_by(Poly a, const int *vars);      /* terms that share their part in vars side by side */
Poly next_group(Poly sorted, int *from, const int *vars);
Ref  grouped(Dag *dag, const Leaves *leaves, Poly density, const int *outer);
Ref  horner(Dag *dag, Poly a, int var);

/* ---- constants.c: the numbers that are not rational, each as the nearest double exactly ------ */

enum { LEGENDRE_MAX = 51, JACOBI_MAX = 18 }; /* nodes: cubics of MAX_DEGREE, conics of it */
enum { NUMBER_PI, NUMBER_HALF_LN2, NUMBER_SQRT_HALF, NUMBERS };
typedef struct { int count; const Rat *coef; } Series;   /* lowest power first */

Rat  number(int which);
/* Nodes t >= 0 of [-1,1], ascending, -t has the same weight; returns how many, (nodes + 1) / 2. */
int  gauss_legendre(int nodes, Rat *node, Rat *weight);
/* Weight function sqrt(1 - s) on [0,1], ascending; returns nodes. */
int  gauss_jacobi(int nodes, Rat *node, Rat *weight);
int  gauss_jacobi_nodes(int degree, int is_float);   /* that moments of conics, 0 <= w <= 3, take */
/* K(tau) = (atanh(sqrt tau) / sqrt tau - 1) / tau, 0 <= tau <= (3 - 2 sqrt 2)^2 */
Series series_atanh(int is_float);
/* E(w - 1), 0 <= w <= 2, where a conic's f(w) = g + g E(w - 1), g = w / (w + conic_shift) */
Series series_conic(int is_float);
extern const Rat conic_shift;

/* ---- bound.c: how far rounding can carry a program off -------------------------------------- */

enum { WORTHLESS = 1 << 20 };                /* the largest k; no scheme so bad is taken */
typedef struct { int k; int repeat; } Bound; /* error <= gamma_k W; repeat: roundings per item */

Bound  bound_edge(const Dag *dag, const Integral *want);
Bound *bound_ring(const Dag *dag, const Dag *finish, const Integral *want, int count);
/* W is the program's own sum with every term positive: the longest path of roundings. */
Bound  bound_path(const Dag *dag);

/* ---- moments.c: schemes for all moments to a degree ------------------------------------------ */

Dag *moments_shared(void);                   /* degree 2 */
Dag *moments_even_power(int degree);         /* 0 .. 4 */
Dag *moments_recurrence(int degree);         /* 1 and more */
Dag *moments_matrix(const Integral *want, int degree);
Dag *moments_vertex(Rat value);              /* a constant integrand */
/* Sums of all terms with positive sign, for the error bound of the moments to a degree. */
Dag *moments_magnitudes(int degree);
Integral moments_vertex_magnitude(void);     /* what degree 0 of them is */
/* The forms of all moments to a degree; `factor` times the next accumulator joins x^m y^n. */
void finish_room(Dag *dag, int degree);
void finish_next(Dag *dag, int m, int n, Rat factor);

/* ---- compensated.c: the area in twice the precision ------------------------------------------ */

Dag *compensated_area(void);

/* ---- curves.c: quadratic and cubic edges ----------------------------------------------------- */

Dag *curve_area_edge(int window);            /* of one edge, line too: negated when reversed */
Dag *curve_monomial_edge(int window, int m, int n);
/* All moments to a degree, accumulated; expanded if that is preferred, and the degree is low. */
Dag *curve_moments(int window, int degree, const char *preferred);
int  curve_nodes(int window, int degree);    /* of the Gauss-Legendre rule that is exact */

/* ---- logarithm.c: for what is not polynomial ------------------------------------------------- */

/* 1/2 log z = atanh((z-1)/(z+1)), z >= 1, where k > 0; K of tau, or of what is left of z where
 * k = 0 or tau is NONE. */
typedef struct { Ref k, half, series; } Logarithm;
Logarithm logarithm(Dag *dag, int is_float, Ref z, Ref tau);
Ref series_value(Dag *dag, Series series, Ref x);    /* Horner */

/* ---- distance.c: powers of the distance, and the closure sum --------------------------------- */

Dag *distance_power(int power, int is_float);   /* -1, 1, 3, 5 */
Dag *closure_sum(void);

/* ---- conic.c: the cap between a conic edge and its chord ------------------------------------- */

Dag *conic_cap(int degree, int is_float);

/* ---- cells.c: a filter as polynomials between its knots -------------------------------------- */

typedef struct {
	int  separable, columns, rows;
	Rat  *x, *y;                         /* knots: one more than columns, rows */
	Poly *across, *up, *all;             /* see cells.c; of each column, cell, column */
} Cells;

Cells filter_cells(const Filter *filter);
Poly  cells_up(const Cells *cells, int column, int row);
int   cells_nodes(Poly across, Poly up);     /* of the rule that is exact along a line */

/* ---- window.c: an edge and a rectangle, or the support of a filter --------------------------- */

typedef struct { Ref middle, half; } Span;   /* of a coordinate along a segment */

Dag *window_coverage(void);
Dag *window_filter(const Filter *filter);    /* centred at the origin */
Ref  cell_value(Dag *dag, Poly a, Ref x, Ref y);   /* NONE for 0 */
Span cell_span(Dag *dag, Ref start, Ref end);
/* x and y at +tau and -tau; how many points they are. */
int  cell_node(Dag *dag, Span x, Span y, Rat tau, Ref point[2][2]);

/* ---- deposit.c: an edge within one cell, and all pixels whose support holds it -------------- */

enum { DEPOSIT_SIZE = 8 };                   /* pixels per axis at most */
int  deposit_size(const Filter *filter); /* pixels per axis, or 0 if knots are not pixels apart */
Dag *deposit(const Filter *filter);
int  deposit_nodes(const Filter *filter);    /* of its rule */
Rat  deposit_unit(const Filter *filter);     /* of the outputs */
Rat  in_units(Rat value, Rat unit);          /* the nearest multiple */

/* ---- scheme.c: ways to evaluate, and the choice by cost -------------------------------------- */

/* On the FMA pipe (mul included), adder, divider (square roots too); mul alone. */
typedef struct { int fma, add, divide, mul; } Count;

Dag *scheme_edge(const Integral *want);      /* one edge by the matrix, ends interchangeable */
/* Accumulators of a ring: the preferred scheme if it applies, else the cheapest. */
Dag *scheme_ring(const Integral *want, int moments, const char *preferred);
Dag *scheme_finish(const Dag *ring);         /* accumulator sums -> moments */
const char *const *scheme_names(void);       /* ends with NULL */

/* ---- schedule.c: order and live ranges ------------------------------------------------------- */

typedef struct {
	const Dag *dag;
	Ref  *order; int count;              /* operations as evaluated, inputs left out */
	int  *last;                          /* position of the last use of each node */
	int   live;                          /* most values alive at once, accumulators left out */
	int   depth;                         /* longest chain of operations */
	Count cost;
} Program;

Program schedule(const Dag *dag);
void program_dump(Text *text, const Program *program);
/* A bug unless the operands of this step are ready, and said to be alive. */
void program_check_step(const Program *program, int at, const unsigned char *ready);

/* ---- proof.c: the always-on checks --------------------------------------- */

void   prove_dag(const Dag *dag, const Integral *want, int count, const char *pass);
void   prove_program(const Program *program, const Integral *want, int count);
void   prove_finish(const Program *finish, const Dag *ring);

/* ---- residue.c: exact arithmetic modulo a prime ---------------------------------------------- */

typedef uint64_t Residue;
#define PRIME ((1ull << 61) - 1)
typedef struct { Residue residue; Int near; } Number;   /* and roughly how large it is */

Residue residue_add(Residue a, Residue b);
Residue residue_subtract(Residue a, Residue b);
Residue residue_multiply(Residue a, Residue b);
Residue residue_power(Residue a, uint64_t exponent);
Residue residue_inverse(Residue a);
Residue residue_of(Rat a);
Number  number_of(Rat a);
/* Every value of a program for coordinates x0, y0, x1, ...; accumulators begin at 0. NULL if it is
 * too close to call what the program selects. */
Number *residue_run(const Program *program, const Number *coordinate);

/* ---- modular.c: the check of sums over quadrature nodes -------------------------------------- */

/* The moments to degree m, or the one of x^m y^n if the program has no finish. */
void   prove_quadrature(const Program *program, int m, int n);

/* ---- pieces.c: the check of programs that select --------------------------------------------- */

void   prove_coverage(const Program *program);
void   prove_window(const Program *program, const Filter *filter);
void   prove_deposit(const Program *program, const Filter *filter);

/* ---- kernel.c: the list of kernels of a request, built and proven ---------------------------- */

typedef struct {                             /* one single-edge function */
	const Integrand *what;               /* NULL: area */
	int window;
	Integral integral;                   /* of a line edge */
	Program  program;                    /* portable: reversal must negate it bit for bit */
	Bound    bound;
} Edge;

typedef struct {                             /* one family member that runs over rings */
	const char *name;                    /* moments_8, x4y2, soft */
	const char *family;                  /* moments, quad, radius, ... : see kernel.c */
	int m, n;                            /* degree 0 of a family, exponents, -1 -1 */
	int outputs, accumulators, turns, window;    /* accumulators of all turns */
	const char *scheme;
	Program portable[2], fused[2];       /* double, float */
	Program finish;
	Bound *bound;                        /* per output, of the portable program */
	Bound  worst;
	const Filter *filter;                /* of its family, else NULL */
} Ring;

/* What adds a piece of an edge to filtered images, in float. */
typedef struct { const Filter *filter; Program portable, fused; } Deposited;

typedef struct {
	Edge *edge; int edges;
	Ring *ring; int rings;
	Deposited *deposit; int deposits;
} Kernels;

/* `letters` choose what is dumped into `text`: p polynomials, d dag, f fused, s schedule. */
Edge build_edge(const Integrand *what);      /* a line edge */
const char *edge_name(const Edge *edge);     /* line_x4y2, cubic_area */
Kernels build_kernels(const Request *request, void (*progress)(int done, int of),
	const char *letters, Text *text);

/* ---- emit*.c: kernels -> C ------------------------------------------------------------------- */

typedef struct { const char *name; Text text; } File;
typedef struct { File *file; int count; } Files;

typedef struct {                             /* a vector instruction set; [0] double, [1] float */
	const char *header, *prefix;
	const char *type[2], *suffix[2];
	int width[2];                        /* lanes of one register */
	int registers;
	int spelling;                        /* column of ops.def */
	const char *load, *store;            /* $1 pointer, $2 value */
	const char *shift[2];                /* $1 this, $2 next vector, $3 by how many; or NULL */
	const char *mask[2], *load_masked;   /* type of a mask; $1 pointer, $2 mask; or NULL */
	int keeps;                           /* what is loaded is hidden, lest it be loaded twice */
} Vector;

typedef struct {                             /* one row per target */
	const char *name;                    /* suffix of its kernels */
	unsigned bit;
	int fused;                           /* runs the fused program */
	const char *guard;                   /* macro that is 1 if the compiler can, or NULL */
	const char *condition;               /* what it is 1 for */
	const char *attribute;               /* macro before each kernel, or NULL */
	const char *about;
	const Vector *vector;                /* NULL: scalar */
} Target;
extern const Target targets[];
extern const int target_count;
/* The program of a ring that a target runs. */
const Program *emit_ring_program(const Ring *ring, const Target *target, int is_float);

typedef struct { const char *real, *suffix, *unit; int is_float, lanes; unsigned bit; } Precision;
extern const Precision precisions[];
extern const int precision_count;

/* Numbers that stay the same for all items of a lane: name = origin[place * L + lane]. */
typedef struct { const char *name; int place, window; } Constant;
enum { CONSTANTS = 5 };
extern const Constant constants[CONSTANTS];

/* What an item of a ring reads: name = array[i + ahead * reach], for programs with this window. */
typedef struct { const char *name, *array; int ahead, window; } Load;
enum { LOADS = 32 };
extern const Load loads[LOADS];

typedef struct {                             /* how a program is written */
	const Precision *precision;
	int nested, indent;
	int first;                           /* number of the first accumulator */
	const char *accumulator, *output;    /* patterns: "acc%d", "acc%d = " */
	const Vector *vector;                /* NULL: scalar */
} Style;

enum { FILE_SIZE = 120000 };                 /* start another file: nobody reviews more */
Text *file_new(Files *files, const char *name);
void emit_banner(Text *text, const char *name, const char *purpose, const Request *request);
void emit_wrapped(Text *text, const char *start, const char *margin, const char *words);
/* Broken at operators if it is too wide. */
void emit_statement(Text *text, int indent, const char *statement);
char *emit_upper(const char *text);
char *emit_divisions(const Program *program);   /* ", 3 div or sqrt", or nothing */
char *emit_place(const Load *load, int turn);  /* index of what item i + turn * step reads */
char *emit_spelling(const char *pattern, const Style *style, char *const *argument);
void emit_program(Text *text, const Program *program, const Style *style);
/* One or two items at a time; open and close surround the turn of each accumulator. */
void emit_stored(Text *text, const Program *program, const Style *style, int items,
	void (*open)(const void *to, int accumulator),
	void (*close)(const void *to, int accumulator), const void *to);

/* All ew_line_NAME, ew_cubic_NAME, ... with their comments. */
char *emit_parameters(int window, const char *real);   /* "double x0, double y0, ..." */
void emit_edges(Files *files, const Request *request, const Kernels *kernels);
void emit_show(Text *text, const Integrand *monomial, const char *format_name);   /* --show */
/* The body of a ring kernel whose lanes run side by side, after its signature. */
void emit_vector_body(Text *text, const Ring *ring, const Target *target,
	const Precision *precision);
void emit_vector_finish(Text *text, const Ring *ring, const Target *target);
int  emit_finishes_columns(const Ring *ring);  /* is there a batch function of this ring? */
int  emit_has_item(const Ring *ring);          /* does that never leave the registers? */
/* One item of vectors that are in registers already, as an inline function. */
void emit_vector_item(Text *text, const Ring *ring, const Target *target,
	const Precision *precision);
void emit_rings(Files *files, const Request *request, const Kernels *kernels);
/* Of filters: kernels per target, and edgewise_filters.c. */
void emit_deposits(Files *files, const Request *request, const Kernels *kernels);
/* The beginning of edgewise_kernels.h. */
void emit_environment(Text *text, const Request *request);
/* edgewise_kernels.h, edgewise.h, and the manifest (JSON, all but the files). */
void emit_list(Files *files, const Request *request, const Kernels *kernels);
void emit_header(Files *files, const Request *request, const Kernels *kernels);
void emit_manifest(Text *text, const Request *request, const Kernels *kernels);

/* ---- bundle.c: what the user gets: runtime, prefix, single header, manifest ------------------ */

extern const Embedded embedded_runtime[];    /* runtime/; ends with a NULL name */

void bundle_runtime(Files *files);
void bundle_rename(Files *files, const char *prefix);
char *bundle_name(const char *name, const char *prefix);   /* edgewise_x.c under this prefix */
Text bundle_manifest(const Files *files, const Request *request, const Kernels *kernels);
Text bundle_single_header(const Files *files, const Request *request);
Text bundle_depfile(const Files *outputs, const Request *request);

/* ---- deliver.c: the only file that writes to disk -------------------------------------------- */

typedef struct {
	const char *out, *manifest;
	const char *const *sources;          /* files that were read; ends with NULL */
	int check, dry_run, verbose, quiet;
} Delivery;

/* `folder` goes to directory out (NULL: no directory) under a manifest that names what gen wrote
 * there; `single` are paths of their own. No source is written over. Returns the exit status. */
int deliver(const Files *folder, const Files *single, const Delivery *how);

#endif
