/* countries.c - outlines on the globe as a map without gaps.
 *
 * Reads shapes made of rings and holes (data/countries.txt describes the format) and projects them
 * about one point: Lambert's azimuthal equal-area projection, which shows the whole globe in a
 * disc. Only the point opposite to the middle is torn; the world's middle is chosen so that no
 * country has it.
 *
 * Countries that share a vertex are neighbours and get different colours, the first free one each.
 * All countries of a colour make one drawing. Rings run counterclockwise seen from above; drawn
 * with y downwards they run clockwise. */
#include "render.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846
#define WORLD_LON 18.0
#define WORLD_LAT 30.0

enum { LONGEST_LINE = 200, LONGEST_NAME = 40 };

typedef struct {
	double v[3]; /* on the unit sphere */
	size_t ring, country;
} Vertex;

typedef struct {
	char name[LONGEST_NAME + 1];
	int colour;
} Country;

typedef struct {
	const char *file;
	long line;
	Vertex *vertices;
	Country *countries;
	size_t vertex_count, ring_count, country_count;
	size_t ring_size; /* vertices of the last ring */
	bool open;        /* that ring takes more */
} Atlas;

/* ---- reading ---- */

static _Noreturn void refuse(const Atlas *atlas, const char *what)
{
	fail("%s:%ld: %s", atlas->file, atlas->line, what);
}

static void direction(double lon, double lat, double v[3])
{
	v[0] = cos(lat * (PI / 180)) * cos(lon * (PI / 180));
	v[1] = cos(lat * (PI / 180)) * sin(lon * (PI / 180));
	v[2] = sin(lat * (PI / 180));
}

static void open_country(Atlas *atlas, const char *name)
{
	if (strlen(name) > LONGEST_NAME || !*name)
		refuse(atlas, "expected a name of 1 to 40 bytes after 'shape'");
	atlas->countries = grow(atlas->countries, atlas->country_count, sizeof(Country));
	Country *country = &atlas->countries[atlas->country_count++];
	country->colour = -1;
	strcpy(country->name, name);
}

static void close_ring(Atlas *atlas)
{
	if (atlas->open && atlas->ring_size < 3)
		refuse(atlas, "the ring above has fewer than 3 vertices");
	atlas->open = false;
}

static void open_ring(Atlas *atlas)
{
	close_ring(atlas);
	if (!atlas->country_count)
		refuse(atlas, "a ring before the first shape");
	atlas->ring_count++;
	atlas->ring_size = 0;
	atlas->open = true;
}

static void add_vertex(Atlas *atlas, const char *text)
{
	double lon, lat;
	char more;
	if (sscanf(text, "%lf %lf %c", &lon, &lat, &more) != 2)
		refuse(atlas, "expected 'shape NAME', 'ring', 'hole' or 'LONGITUDE LATITUDE'");
	if (!(fabs(lon) <= 180) || !(fabs(lat) <= 90))
		refuse(atlas, "longitudes reach from -180 to 180, latitudes from -90 to 90");
	if (!atlas->open)
		refuse(atlas, "a vertex outside of a ring");
	atlas->vertices = grow(atlas->vertices, atlas->vertex_count, sizeof(Vertex));
	Vertex *vertex = &atlas->vertices[atlas->vertex_count++];
	direction(lon, lat, vertex->v);
	vertex->ring = atlas->ring_count - 1;
	vertex->country = atlas->country_count - 1;
	atlas->ring_size++;
}

static void read_line(Atlas *atlas, char *line)
{
	line[strcspn(line, "\r\n")] = '\0';
	if (!*line || *line == '#')
		return;
	if (!strncmp(line, "shape ", 6)) {
		close_ring(atlas);
		open_country(atlas, line + 6);
	} else if (!strcmp(line, "ring") || !strcmp(line, "hole")) {
		open_ring(atlas);
	} else {
		add_vertex(atlas, line);
	}
}

static void read_file(Atlas *atlas)
{
	char line[LONGEST_LINE + 2];
	FILE *stream = fopen(atlas->file, "r");
	while (stream && fgets(line, sizeof line, stream)) {
		atlas->line++;
		if (strlen(line) > LONGEST_LINE)
			refuse(atlas, "the line is too long");
		read_line(atlas, line);
	}
	if (!stream || ferror(stream))
		fail("cannot read %s: %s", atlas->file, strerror(errno));
	fclose(stream);
	if (!atlas->vertex_count)
		refuse(atlas, "the file has no shape");
	close_ring(atlas);
}

/* ---- colours ---- */

static int by_place(const void *left, const void *right)
{
	const Vertex *a = *(const Vertex *const *)left, *b = *(const Vertex *const *)right;
	return memcmp(a->v, b->v, sizeof a->v);
}

/* touch[a * countries + b]: a and b have a vertex in common. */
static bool *find_neighbours(const Atlas *atlas)
{
	const size_t n = atlas->country_count;
	bool *touch = allocate(n * n, sizeof *touch);
	const Vertex **order = allocate(atlas->vertex_count, sizeof(Vertex *));
	for (size_t i = 0; i < atlas->vertex_count; i++)
		order[i] = &atlas->vertices[i];
	qsort(order, atlas->vertex_count, sizeof *order, by_place);
	for (size_t i = 0; i < atlas->vertex_count; i++)
		for (size_t k = i + 1; k < atlas->vertex_count && !by_place(&order[i], &order[k]);
		     k++) {
			touch[order[i]->country * n + order[k]->country] = true;
			touch[order[k]->country * n + order[i]->country] = true;
		}
	free(order);
	return touch;
}

static void choose_colours(Atlas *atlas)
{
	const size_t n = atlas->country_count;
	bool *touch = find_neighbours(atlas);
	for (size_t i = 0; i < n; i++) {
		int uses[MAP_COLOURS] = { 0 };
		for (size_t k = 0; k < i; k++)
			if (touch[i * n + k])
				uses[atlas->countries[k].colour]++;
		/* Start elsewhere each time, so that no colour prevails. */
		int best = (int)(i % MAP_COLOURS);
		for (int c = 0; c < MAP_COLOURS; c++) {
			const int colour = (int)((i + (size_t)c) % MAP_COLOURS);
			if (uses[colour] < uses[best])
				best = colour;
		}
		atlas->countries[i].colour = best;
	}
	free(touch);
}

/* ---- the map ---- */

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The middle of the vertices of one country, or of the world: longitude and latitude. */
static void find_middle(const Atlas *atlas, const char *only, double middle[2])
{
	double mean[3] = { 0, 0, 0 };
	bool found = false;
	middle[0] = WORLD_LON;
	middle[1] = WORLD_LAT;
	for (size_t i = 0; only && i < atlas->vertex_count; i++) {
		const Vertex *vertex = &atlas->vertices[i];
		if (strcmp(atlas->countries[vertex->country].name, only))
			continue;
		found = true;
		for (int k = 0; k < 3; k++)
			mean[k] += vertex->v[k];
	}
	if (only && !found)
		fail("%s has no shape named %s", atlas->file, only);
	if (only) {
		middle[0] = atan2(mean[1], mean[0]) * (180 / PI);
		middle[1] = atan2(mean[2], hypot(mean[0], mean[1])) * (180 / PI);
	}
}

void map_read_file(const char *file, const char *only, Map *map)
{
	Atlas atlas = { .file = file };
	double middle[2], up[3], east[3], north[3];
	read_file(&atlas);
	choose_colours(&atlas);
	find_middle(&atlas, only, middle);
	direction(middle[0], middle[1], up);
	direction(middle[0] + 90, 0, east);
	direction(middle[0], middle[1] + 90, north);
	*map = (Map){ 0 };
	for (size_t i = 0; i < atlas.vertex_count; i++) {
		const Vertex *vertex = &atlas.vertices[i];
		const Country *country = &atlas.countries[vertex->country];
		if (only && strcmp(country->name, only))
			continue;
		const double scale = sqrt(2 / (1 + dot(vertex->v, up)));
		const double x = scale * dot(vertex->v, east);
		const double y = -scale * dot(vertex->v, north);
		if (i && vertex[-1].ring == vertex->ring)
			drawing_line(&map->land[country->colour], x, y);
		else
			drawing_move(&map->land[country->colour], x, y);
	}
	free(atlas.vertices);
	free(atlas.countries);
}

void map_free(Map *map)
{
	for (int i = 0; i < MAP_COLOURS; i++)
		drawing_free(&map->land[i]);
}
