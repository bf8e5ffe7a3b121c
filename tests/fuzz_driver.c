/* fuzz_driver.c - runs LLVMFuzzerTestOneInput without libFuzzer: mutated seeds, no feedback.
 *
 *     PROGRAM RUNS SEED MAXIMUM DICTIONARY FILE...
 *
 * Every input is one of the files or, half of the time, one of the last inputs, with up to eight
 * changes: a byte, a part left out or doubled, a word of the dictionary (libFuzzer's format), a
 * part of another file. What is run is kept in ./fuzz.input, so that a crash leaves it behind.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST = 4096, FILES = 100, WORDS = 200, LAST = 50 };

typedef struct { uint8_t data[MOST]; size_t size; } Input;

static Input file[FILES], word[WORDS], last[LAST];
static size_t files, words, maximum;
static uint64_t state;

/* 0 .. count-1; splitmix64 */
static size_t draw(size_t count)
{
	uint64_t z = state += 0x9e3779b97f4a7c15u;
	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
	return count ? (size_t)((z ^ (z >> 31)) % count) : 0;
}

static void stop(const char *why, const char *name)
{
	fprintf(stderr, "fuzz_driver: %s %s\n", why, name);
	exit(2);
}

static void read_seed(const char *name)
{
	FILE *in = fopen(name, "rb");
	if (!in || files == FILES)
		stop("cannot read", name);
	file[files].size = fread(file[files].data, 1, MOST, in);
	fclose(in);
	files++;
}

/* Lines "..." with \\, \" and \xHH. */
static void read_words(const char *name)
{
	char line[1000];
	FILE *in = fopen(name, "r");
	if (!in)
		stop("cannot read", name);
	while (fgets(line, sizeof line, in)) {
		if (line[0] != '"' || words == WORDS)
			continue;
		Input *w = &word[words++];
		for (const char *p = line + 1; *p && *p != '"'; p++) {
			unsigned code;
			if (p[0] == '\\' && p[1] == 'x' && sscanf(p + 2, "%2x", &code) == 1) {
				w->data[w->size++] = (uint8_t)code;
				p += 3;
			} else {
				p += *p == '\\';
				w->data[w->size++] = (uint8_t)*p;
			}
		}
	}
	fclose(in);
}

/* Puts bytes in place of data[at .. at+gone-1], as far as there is room. */
static void replace(Input *input, size_t at, size_t gone, const uint8_t *data, size_t size)
{
	Input result = { { 0 }, at };
	memcpy(result.data, input->data, at);
	if (size > maximum - at)
		size = maximum - at;
	if (size)
		memcpy(result.data + at, data, size);
	result.size += size;
	size_t rest = input->size - at - gone;
	if (rest > maximum - result.size)
		rest = maximum - result.size;
	memcpy(result.data + result.size, input->data + at + gone, rest);
	result.size += rest;
	*input = result;
}

static void change(Input *input)
{
	const size_t at = draw(input->size + 1), room = input->size - at;
	const size_t gone = draw((room < 20 ? room : 20) + 1);
	const uint8_t byte = (uint8_t)draw(256);
	const Input *other = draw(4) ? &word[draw(words)] : &file[draw(files)];
	const size_t from = other >= word && other < word + words ? 0 : draw(other->size);
	switch (draw(4)) {
	case 0:
		replace(input, at, room > 0, &byte, 1);
		break;
	case 1:
		replace(input, at, gone, NULL, 0);
		break;
	case 2:
		replace(input, at, draw(2) ? gone : 0, other->data + from, other->size - from);
		break;
	default:
		replace(input, draw(input->size + 1), 0, input->data + at, gone);
		break;
	}
}

static void keep(const Input *input)
{
	FILE *out = fopen("fuzz.input", "wb");
	if (!out)
		stop("cannot write", "fuzz.input");
	fwrite(input->data, 1, input->size, out);
	fclose(out);
}

int main(int argc, char **argv)
{
	if (argc < 6)
		stop("arguments:", "RUNS SEED MAXIMUM DICTIONARY FILE...");
	const unsigned long long runs = strtoull(argv[1], NULL, 10);
	state = strtoull(argv[2], NULL, 10);
	maximum = strtoull(argv[3], NULL, 10);
	if (maximum == 0 || maximum > MOST)
		stop("no size of an input:", argv[3]);
	read_words(argv[4]);
	for (int i = 5; i < argc; i++)
		read_seed(argv[i]);
	for (unsigned long long run = 0; run < runs; run++) {
		Input input = run >= LAST && draw(2) ? last[draw(LAST)] : file[draw(files)];
		if (input.size > maximum)
			input.size = maximum;
		for (size_t i = draw(9); i > 0; i--)
			change(&input);
		keep(&input);
		LLVMFuzzerTestOneInput(input.data, input.size);
		last[run % LAST] = input;
	}
	remove("fuzz.input");
	printf("Done %llu runs\n", runs);
	return 0;
}
