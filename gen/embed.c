/* embed.c - writes files as C strings, so that gen can emit a self-contained folder and
 * knows filters of its own.
 *
 * Built and run before gen: embed TABLE FILE... >table.c, a const Embedded TABLE[] that ends with
 * a NULL name. Lines become string literals; nothing is interpreted. */
#include <stdio.h>
#include <string.h>

static void write_line(const char *line)
{
	putchar('"');
	for (; *line; ++line) {
		if (*line == '\n')
			fputs("\\n", stdout);
		else if (*line == '\t')
			fputs("\\t", stdout);
		else if (*line == '"' || *line == '\\')
			printf("\\%c", *line);
		else
			putchar(*line);
	}
	puts("\"");
}

static int write_file(const char *path, int number)
{
	char line[4096];
	FILE *file = fopen(path, "r");
	if (!file) {
		fprintf(stderr, "embed: cannot read %s\n", path);
		return 1;
	}
	printf("static const char file%d[] =\n", number);
	while (fgets(line, sizeof line, file))
		write_line(line);
	puts(";");
	return fclose(file);
}

int main(int argc, char **argv)
{
	if (argc < 3) {
		fputs("usage: embed TABLE FILE...\n", stderr);
		return 2;
	}
	puts("#include \"gen.h\"\n");
	for (int i = 2; i < argc; ++i)
		if (write_file(argv[i], i - 1))
			return 1;
	printf("const Embedded %s[] = {\n", argv[1]);
	for (int i = 2; i < argc; ++i) {
		const char *slash = strrchr(argv[i], '/');
		printf("{ \"%s\", file%d, sizeof file%d - 1 },\n",
			slash ? slash + 1 : argv[i], i - 1, i - 1);
	}
	puts("{ NULL, NULL, 0 }\n};");
	return fflush(stdout) || ferror(stdout);
}
