/* bundle.c - from emitted files to what the user gets.
 *
 * Printers and runtime speak of ew_, EW_ and edgewise only; another prefix is one renaming of whole
 * tokens at the end, over every text and file name alike. The single header is the public header
 * followed, under EW_IMPLEMENTATION, by all other files, with each include of our own replaced by
 * its text (headers with a guard once, templates every time). */
#include "gen.h"

#include <string.h>

void bundle_runtime(Files *files)
{
	for (const Embedded *file = embedded_runtime; file->name; ++file)
		text_append(file_new(files, file->name), file->text, file->size);
}

/* ---- prefix ---- */

static int is_word(int c)
{
	return c == '_' || (c >= '0' && c <= '9')
		|| (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

typedef struct { const char *from; size_t size; const char *to; } Rule;

static void rename_token(Text *out, const char *token, size_t size, const Rule *rules, int count)
{
	for (int i = 0; i < count; ++i) {
		const Rule *rule = &rules[i];
		if (size < rule->size || memcmp(token, rule->from, rule->size) != 0)
			continue;
		int whole = rule->from[rule->size - 1] == '_' || size == rule->size
			|| token[rule->size] == '_';
		if (whole) {
			text_add(out, "%s", rule->to);
			token += rule->size;
			size -= rule->size;
			break;
		}
	}
	text_append(out, token, size);
}

static Text renamed(const char *data, size_t size, const char *prefix)
{
	char *upper = copy_string(prefix, strlen(prefix));
	for (char *p = upper; *p; ++p)
		*p = *p >= 'a' && *p <= 'z' ? (char)(*p - 'a' + 'A') : *p;
	const Rule rules[] = {
		{ "ew_", 3, format("%s_", prefix) }, { "EW_", 3, format("%s_", upper) },
		{ "edgewise", 8, prefix }, { "EDGEWISE", 8, upper },
	};
	Text out = { 0 };
	text_append(&out, "", 0);
	for (size_t i = 0; i < size; ) {
		size_t end = i;
		while (end < size && is_word((unsigned char)data[end]))
			++end;
		if (end > i)
			rename_token(&out, data + i, end - i, rules, LENGTH(rules));
		else
			text_append(&out, data + end++, 1);
		i = end;
	}
	return out;
}

char *bundle_name(const char *name, const char *prefix)
{
	if (!prefix)
		return copy_string(name, strlen(name));
	Text text = renamed(name, strlen(name), prefix);
	return text_take(&text);
}

void bundle_rename(Files *files, const char *prefix)
{
	for (int i = 0; i < files->count && prefix; ++i) {
		File *file = &files->file[i];
		Text text = renamed(file->text.data, file->text.size, prefix);
		text_free(&file->text);
		file->text = text;
		file->name = bundle_name(file->name, prefix);
	}
}

Text bundle_manifest(const Files *files, const Request *request, const Kernels *kernels)
{
	Text text = { 0 };
	emit_manifest(&text, request, kernels);
	if (request->prefix) {
		Text head = renamed(text.data, text.size, request->prefix);
		text_free(&text);
		text = head;
	}
	text_add(&text, " \"files\": [");
	for (int i = 0; i < files->count; ++i) {
		const File *file = &files->file[i];
		unsigned long long hash = text_hash(file->text.data, file->text.size);
		text_add(&text, "%s\n  {\"file\": \"%s\", \"bytes\": %zu, \"fnv1a64\": "
			"\"%016llx\"}", i ? "," : "", file->name, file->text.size, hash);
	}
	text_add(&text, "\n ]}\n");
	return text;
}

/* ---- single header ---- */

static const File *find_file(const Files *files, const char *name, size_t size)
{
	for (int i = 0; i < files->count; ++i)
		if (strlen(files->file[i].name) == size
		    && memcmp(files->file[i].name, name, size) == 0)
			return &files->file[i];
	return NULL;
}

/* The file that this line includes, if it is one of ours. */
static const File *included(const Files *files, const char *line)
{
	static const char start[] = "#include \"";
	const char *name = line + sizeof start - 1;
	if (strncmp(line, start, sizeof start - 1) != 0)
		return NULL;
	return find_file(files, name, strcspn(name, "\"\n"));
}

static void expand(Text *out, const Files *files, const File *file, unsigned char *done)
{
	const char *line = file->text.data;
	if (strstr(line, "_H\n#define") && done[file - files->file]++)
		return;
	while (*line) {
		size_t size = strcspn(line, "\n") + 1;
		const File *inner = included(files, line);
		if (inner)
			expand(out, files, inner, done);
		else
			text_append(out, line, size);
		line += size;
	}
}

Text bundle_single_header(const Files *files, const Request *request)
{
	Text text = { 0 };
	const char *upper = request->prefix ? bundle_name("EW_", request->prefix) : "EW_";
	unsigned char *done = allocate((size_t)files->count);
	char *header = bundle_name("edgewise.h", request->prefix);
	text_add(&text, "/* %s - single header: include it anywhere, and in one file define "
		"%sIMPLEMENTATION before.\n"
		" * Link with -lm. The implementation switches floating-point contraction off for "
		"the rest of its file. */\n",
		header, upper);
	expand(&text, files, find_file(files, header, strlen(header)), done);
	text_add(&text, "\n#if defined(%sIMPLEMENTATION) && !defined(%sIMPLEMENTED)\n"
		"#define %sIMPLEMENTED\n", upper, upper, upper);
	for (int i = 0; i < files->count; ++i)
		if (strcmp(files->file[i].name + strlen(files->file[i].name) - 2, ".c") == 0)
			expand(&text, files, &files->file[i], done);
	text_add(&text, "\n#endif\n");
	return text;
}

/* ---- dependencies ---- */

static void add_path(Text *text, const char *path)
{
	for (const char *p = path; *p; ++p)
		text_add(text, strchr(" #:%\\", *p) ? "\\%c" : *p == '$' ? "$%c" : "%c", *p);
}

Text bundle_depfile(const Files *outputs, const Request *request)
{
	Text text = { 0 };
	for (int i = 0; i < outputs->count; ++i) {
		text_add(&text, "%s", i ? " \\\n " : "");
		add_path(&text, outputs->file[i].name);
	}
	text_add(&text, ":");
	for (const char *const *path = spec_paths(request); *path; ++path) {
		text_add(&text, " \\\n ");
		add_path(&text, *path);
	}
	text_add(&text, "\n");
	return text;
}
