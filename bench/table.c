/* table.c - tables of figures, with the bars they are held against.
 *
 * A table is filled row by row, each cell in the order of the columns, then printed for people;
 * all tables stay in memory and can be written as JSON, so a machine reads the very figures that
 * were shown. A bar is a column after the figure it belongs to; a figure beyond its bar gets an
 * exclamation mark. Columns that follow each other in one group share a heading. */
#include "bench.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COLUMNS = 24, MAX_ROWS = 160, MAX_TABLES = 40, CELL = 24, LABEL = 48 };

typedef enum { FIGURE, AT_MOST, AT_LEAST } Kind;

typedef struct { Kind kind; const char *group, *name; int decimals; } Column;

struct Table {
	const char *key, *title, *note;
	int columns, rows, filled;     /* cells of the last row */
	Column column[MAX_COLUMNS];
	char label[MAX_ROWS][LABEL];
	double cell[MAX_ROWS][MAX_COLUMNS];
};

static Table *tables[MAX_TABLES];
static int table_total;

static void require(int condition, const char *what)
{
	if (!condition) {
		fprintf(stderr, "bench: %s\n", what);
		exit(1);
	}
}

Table *table_new(const char *key, const char *title, const char *note)
{
	Table *table = allocate(sizeof *table);
	require(table_total < MAX_TABLES, "too many tables");
	memset(table, 0, sizeof *table);
	table->key = key;
	table->title = title;
	table->note = note;
	return tables[table_total++] = table;
}

static void add_column(Table *table, Column column)
{
	require(table->columns < MAX_COLUMNS, "too many columns");
	table->column[table->columns++] = column;
}

void table_figures(Table *table, const char *group, const char *name, int decimals)
{
	add_column(table, (Column){ FIGURE, group, name, decimals });
}

static void add_bar(Table *table, Kind kind)
{
	const Column *figure = &table->column[table->columns - 1];
	add_column(table, (Column){ kind, figure->group, "bar", figure->decimals });
}

void table_at_most(Table *table)
{
	add_bar(table, AT_MOST);
}

void table_at_least(Table *table)
{
	add_bar(table, AT_LEAST);
}

void table_row(Table *table, const char *format, ...)
{
	va_list arguments;
	require(table->rows < MAX_ROWS, "too many rows");
	va_start(arguments, format);
	vsnprintf(table->label[table->rows], LABEL, format, arguments);
	va_end(arguments);
	for (int i = 0; i < table->columns; ++i)
		table->cell[table->rows][i] = (double)NAN;
	++table->rows;
	table->filled = 0;
}

void table_put(Table *table, double value)
{
	require(table->filled < table->columns, "a row longer than its table");
	table->cell[table->rows - 1][table->filled++] = value;
}

/* 1 met, 0 missed, -1 there is no bar or nothing to hold against it. */
static int bar_met(const Table *table, int row, int column)
{
	Kind kind = table->column[column].kind;
	if (kind == FIGURE)
		return -1;
	double figure = table->cell[row][column - 1], bar = table->cell[row][column];
	if (isnan(figure) || isnan(bar))
		return -1;
	return kind == AT_MOST ? figure <= bar : figure >= bar;
}

/* ---- print ---- */

static void print_cell(char text[CELL], const Table *table, int row, int column)
{
	const Column *c = &table->column[column];
	double value = table->cell[row][column];
	if (c->kind == FIGURE && isnan(value))
		snprintf(text, CELL, "-");
	else if (c->kind == FIGURE)
		snprintf(text, CELL, "%.*f", c->decimals, value);
	else if (isnan(value))
		snprintf(text, CELL, " ");
	else
		snprintf(text, CELL, "%s%.4g%s", c->kind == AT_MOST ? "<=" : ">=", value,
			bar_met(table, row, column) == 0 ? "!" : " ");
}

static int starts_group(const Table *table, int column)
{
	return column == 0
		|| strcmp(table->column[column].group, table->column[column - 1].group) != 0;
}

/* Two blanks before every column, one more before a group; a group is as wide as its heading. */
static void measure_widths(const Table *table, int width[MAX_COLUMNS])
{
	char text[CELL];
	for (int c = 0; c < table->columns; ++c) {
		width[c] = (int)strlen(table->column[c].name);
		for (int row = 0; row < table->rows; ++row) {
			print_cell(text, table, row, c);
			if ((int)strlen(text) > width[c])
				width[c] = (int)strlen(text);
		}
		width[c] += 2 + starts_group(table, c);
	}
	for (int first = 0, end; first < table->columns; first = end) {
		int total = width[first];
		for (end = first + 1; end < table->columns && !starts_group(table, end); ++end)
			total += width[end];
		int heading = (int)strlen(table->column[first].group) + 3;
		if (heading > total)
			width[end - 1] += heading - total;
	}
}

static void print_groups(const Table *table, const int width[MAX_COLUMNS], int label)
{
	int any = 0;
	for (int c = 0; c < table->columns; ++c)
		any |= table->column[c].group[0] != '\0';
	if (!any)
		return;
	printf("%*s", label, "");
	for (int first = 0, end; first < table->columns; first = end) {
		int total = width[first];
		for (end = first + 1; end < table->columns && !starts_group(table, end); ++end)
			total += width[end];
		printf("%*s", total, table->column[first].group);
	}
	printf("\n");
}

void table_print(const Table *table)
{
	int width[MAX_COLUMNS], label = 0;
	char text[CELL];
	for (int row = 0; row < table->rows; ++row)
		if ((int)strlen(table->label[row]) > label)
			label = (int)strlen(table->label[row]);
	measure_widths(table, width);
	printf("\n== %s ==\n%s%s", table->title, table->note, table->note[0] ? "\n" : "");
	if (table->rows == 0) {
		printf("Nothing to measure on this CPU.\n");
		return;
	}
	print_groups(table, width, label);
	printf("%*s", label, "");
	for (int c = 0; c < table->columns; ++c)
		printf("%*s", width[c], table->column[c].name);
	for (int row = 0; row < table->rows; ++row) {
		printf("\n%-*s", label, table->label[row]);
		for (int c = 0; c < table->columns; ++c) {
			print_cell(text, table, row, c);
			printf("%*s", width[c], text);
		}
	}
	printf("\n");
	fflush(stdout);
}

void tables_summary(void)
{
	int count[2] = { 0, 0 };
	for (int t = 0; t < table_total; ++t)
		for (int row = 0; row < tables[t]->rows; ++row)
			for (int c = 0; c < tables[t]->columns; ++c) {
				int met = bar_met(tables[t], row, c);
				if (met >= 0)
					++count[met];
			}
	if (count[0] + count[1])
		printf("\nbars: %d met, %d missed (marked !)\n", count[1], count[0]);
}

/* ---- JSON ---- */

static void json_string(FILE *out, const char *text)
{
	fputc('"', out);
	for (; *text; ++text)
		fprintf(out, *text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
	fputc('"', out);
}

static void json_columns(FILE *out, const Table *table)
{
	static const char *const kinds[] = { "figure", "at most", "at least" };
	for (int c = 0; c < table->columns; ++c) {
		fprintf(out, "%s\n    {\"kind\": \"%s\", \"group\": ", c ? "," : "",
			kinds[table->column[c].kind]);
		json_string(out, table->column[c].group);
		fprintf(out, ", \"name\": ");
		json_string(out, table->column[c].name);
		fprintf(out, "}");
	}
}

static void json_rows(FILE *out, const Table *table)
{
	for (int row = 0; row < table->rows; ++row) {
		fprintf(out, "%s\n    {\"name\": ", row ? "," : "");
		json_string(out, table->label[row]);
		fprintf(out, ", \"values\": [");
		for (int c = 0; c < table->columns; ++c) {
			double value = table->cell[row][c];
			fprintf(out, c ? ", " : "");
			if (value - value == 0)
				fprintf(out, "%.6g", value);
			else
				fprintf(out, "null");
		}
		fprintf(out, "]}");
	}
}

int tables_json(const char *file, int quick)
{
	FILE *out = fopen(file, "w");
	if (!out)
		return 0;
	fprintf(out, "{\"edgewise\": \"%s\", \"compiler\": ", ew_version());
	json_string(out, __VERSION__);
	fprintf(out, ", \"quick\": %s, \"tables\": [", quick ? "true" : "false");
	for (int t = 0; t < table_total; ++t) {
		fprintf(out, "%s\n  {\"key\": ", t ? "," : "");
		json_string(out, tables[t]->key);
		fprintf(out, ", \"title\": ");
		json_string(out, tables[t]->title);
		fprintf(out, ",\n   \"columns\": [");
		json_columns(out, tables[t]);
		fprintf(out, "],\n   \"rows\": [");
		json_rows(out, tables[t]);
		fprintf(out, "]}");
	}
	fprintf(out, "\n]}\n");
	int good = !ferror(out);
	return fclose(out) == 0 && good;
}
