/* face.h - a font opened by FreeType, for the examples that set text. */
#ifndef FACE_H
#define FACE_H

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include <ft2build.h>
#include FT_FREETYPE_H

/* The program's: says why, and ends it. */
_Noreturn void fail(const char *format, ...);

/* A face with outlines; it goes when the library goes. */
static inline FT_Face open_face(FT_Library *library, const char *file)
{
	FT_Face face;
	FILE *stream = fopen(file, "rb"); /* FreeType does not say why it cannot */
	if (!stream || (getc(stream) == EOF && ferror(stream)))
		fail("cannot read %s: %s", file, strerror(errno));
	fclose(stream);
	if (FT_Init_FreeType(library))
		fail("FreeType does not start");
	const FT_Error error = FT_New_Face(*library, file, 0, &face);
	if (error == FT_Err_Unknown_File_Format)
		fail("%s is not a font that FreeType knows", file);
	if (error)
		fail("%s is a damaged font: FreeType's error 0x%02x", file, (unsigned)error);
	if (!FT_IS_SCALABLE(face) || !face->units_per_EM)
		fail("%s has bitmaps, but no outlines", file);
	return face;
}

#endif
