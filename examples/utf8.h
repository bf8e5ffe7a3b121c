/* utf8.h - characters of UTF-8 text, for the examples that set text. */
#ifndef UTF8_H
#define UTF8_H

#include <stdbool.h>

/* Takes one character from UTF-8 text; -1 if it is none. */
static inline long take_character(const char **text)
{
	static const long least[] = { 0, 0x80, 0x800, 0x10000 };
	const unsigned lead = (unsigned char)*(*text)++;
	const int more = lead < 0x80 ? 0 : lead < 0xe0 ? 1 : lead < 0xf0 ? 2 : 3;
	if ((lead >= 0x80 && lead < 0xc0) || lead > 0xf7)
		return -1;
	long code = more ? (long)(lead & (0x3fu >> more)) : (long)lead;
	for (int i = 0; i < more; i++, ++*text) {
		if ((**text & 0xc0) != 0x80)
			return -1;
		code = code << 6 | (**text & 0x3f);
	}
	const bool surrogate = code >= 0xd800 && code < 0xe000;
	return code < least[more] || code > 0x10ffff || surrogate ? -1 : code;
}

#endif
