/* raster.h - what the files of the raster section share, each building on those above it.
 *
 *   raster_scenes      polygons and their images: glyphs, smooth polygons, a star
 *   raster_exact       what every pixel should be
 *   raster_race        painters and our functions as trials over a set of drawings
 *   raster_contest     a set drawn by everybody
 *   raster_tables      what came of it
 *   raster_filters     tent and cubic filters, against supersampling
 *   raster_windows     kernels of one pixel and deposits
 *   raster_downsample  the filter pass of supersampling, compiled as the peers are
 *   raster_chart       the ratios to FreeType as a plot
 *   raster             the sets, and all of it in order */
#ifndef RASTER_H
#define RASTER_H

#include "bench.h"
#include "peers.h"

/* ---- raster_scenes.c ---- */

typedef struct {
	Scene scene;
	int32_t *offsets;
	double *x, *y;                 /* the same numbers as xf, yf */
	float *xf, *yf;
	unsigned char *verb;           /* of glyphs: the curves that were flattened, or NULL */
	double *point;
	float *pointf;
	size_t verbs, points;
} Drawing;

enum { SET_NAME = 32 };

typedef struct {
	char name[SET_NAME];
	int size, count;
	double pixels, vertices;       /* of a drawing, on average */
	Drawing *drawing;
} Set;

/* Every n-th of the characters 33 to 126, `size` pixels per em, each in the smallest image that
 * holds it and so many pixels more on each side. Curves become lines that are off by at most
 * `tolerance` pixels. Count 0: there is no FreeType, or no such font. */
Set glyphs_make(int size, int margin, double tolerance, int every);
Set smooth_make(int edges, int size);          /* a circle with a few waves */
Set star_make(int edges, int size);            /* seven times around, in and out */
Drawing drawing_scaled(const Drawing *drawing, int factor);
Drawing drawing_refined(const Drawing *glyph, double tolerance);       /* its curves once more */
void drawing_free(Drawing *drawing);
void set_free(Set *set);

/* ---- raster_exact.c ---- */

typedef enum { EXACT_BOX, EXACT_TENT, EXACT_BSPLINE3, EXACT_MITCHELL, EXACT_FILTERS } Filter;

extern const char *const filter_names[EXACT_FILTERS];

double filter_value(Filter filter, double x);
/* Filtered and weighted by the winding number, correct to 1e-15 or so; width numbers per row. */
double *exact_image(const Scene *scene, Filter filter);

/* ---- raster_race.c ---- */

/* Memory for any image of a set. */
typedef struct { unsigned char *bytes; float *floats; } Pixels;

/* One repetition draws all polygons of a set in turn, each `times` times in a row. */
typedef struct { const Painter *painter; int count, times; void **picture; } PaintJob;

typedef enum { TO_BYTES, TO_FLOATS, CURVES } How;      /* CURVES: of a path, to floats */

typedef struct {
	How how;
	int precision;
	unsigned target;
	const ew_filter *filter;       /* not for bytes */
	const Set *set;
	Pixels pixels;
	int times;
} DrawJob;

Pixels pixels_new(const Set *set);
void pixels_free(Pixels *pixels);
void pixels_spoil(Pixels pixels, const Scene *scene);  /* whatever is not written will show */

/* 0 if the painter is not there or one of the polygons is more than it takes. */
int  paint_begin(PaintJob *job, const Painter *painter, const Set *set, Pixels pixels);
void paint_end(PaintJob *job);
TrialRun paint_run;                    /* of a PaintJob, which begun */

void draw_one(const DrawJob *job, const Drawing *drawing);
TrialRun draw_run;                     /* of a DrawJob */

/* The largest difference of any pixel; infinity if one is NaN. Bytes: from coverage, at most 1. */
double worst_byte(const Scene *scene, const unsigned char *pixels, const double *exact);
double worst_float(const Scene *scene, const float *pixels, const double *exact);

/* ---- raster_contest.c ---- */

#define PAINTER_NUMBER(name) name,
enum { PAINTERS(PAINTER_NUMBER) PAINTER_COUNT };

extern const char *const painter_names[PAINTER_COUNT];
extern const Painter *const painters[PAINTER_COUNT];

/* Ways of ours to draw; from BYTES_D on the widest target only. */
enum { BYTES, FLOATS, BYTES_D, FLOATS_D, PATHS, KINDS };

typedef struct { How how; int precision; const char *group; } Way;

extern const Way every_way[KINDS];

/* What ratios to FreeType are wanted for. */
typedef struct { const char *name; int kind; unsigned target; } Goal;

enum { GOALS = 4 };

extern const Goal goals[GOALS];

enum { MOST_TRIALS = PAINTER_COUNT + 2 * MAX_TARGETS + KINDS - BYTES_D };

typedef struct {
	const Target *target[MAX_TARGETS];
	int targets, trials;           /* the first ones are the painters */
} Field;

Field field_here(void);
int   trial_of(const Field *field, int kind, int target);      /* the number of a trial */
int   trial_widest(const Field *field, int kind);
int   trial_on(const Field *field, int kind, unsigned target); /* -1: not on this CPU */

typedef struct {
	char name[SET_NAME];
	double pixels;
	int there[MOST_TRIALS];
	double median[MOST_TRIALS], least[MOST_TRIALS], error[MOST_TRIALS];    /* or NAN */
	double ratio[MOST_TRIALS];     /* FreeType's time in that of the trial */
	double again[GOALS];           /* likewise, each drawing many times in a row */
	const double *bar;             /* for the goals */
	double error_bar;              /* in 1e-6 */
} Drawn;

void contest_hold(const Field *field, Set set, Drawn *drawn, const Effort *effort);

/* ---- raster_tables.c ---- */

void raster_tables(const Field *field, const Drawn *drawn, int sets);

/* ---- raster_downsample.c ---- */

enum { FOLD = 8, MOST_TAPS = 4 * FOLD };

typedef struct { int taps; float weight[MOST_TAPS]; } Polyphase;       /* 16 or 32 taps */

/* Pixel (i,j) of `out` is the weighted sum of taps^2 of the 8 width x 8 height pixels of `fine`,
 * about its point (8i+4, 8j+4); what lies outside counts as 0. Scratch is 2 (8 width + MOST_TAPS)
 * zeros, and again zeros at the ends and in the second half when this is done. */
void downsample(const Polyphase *phase, const float *fine, ptrdiff_t fine_stride, int width,
	int height, float *scratch, float *out, ptrdiff_t out_stride);

/* ---- raster_chart.c ---- */

typedef enum { CHART_U8, CHART_F32, CHART_TENT, CHART_MITCHELL, CHART_CAIRO, CHART_AGG, CHART_STB,
               CHART_SERIES } ChartSeries;

void raster_chart_point(ChartSeries series, int size, double ratio);   /* NAN: nothing */

/* ---- raster_filters.c ---- */

void filters_table(const Effort *effort);

/* ---- raster_windows.c ---- */

void windows_table(const Effort *effort);
void deposits_table(const Effort *effort);

#endif
