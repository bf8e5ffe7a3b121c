/* png.c - a picture as an 8-bit PNG, by libpng.
 *
 * Light is encoded as sRGB, and the file says so. GREY has the luminance; RGBA has colours not
 * multiplied by alpha, and alpha, which PNG wants linear, is the coverage itself.
 *
 * The file appears at once: it is written beside its place and renamed when it is complete. What
 * exists and is no plain file, a device or a pipe, is written in place. */
#define _POSIX_C_SOURCE 200809L
#include "render.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <png.h>

static unsigned char encode(double light)
{
	if (!(light > 0))
		return 0;
	if (light >= 1)
		return 255;
	const double value = light <= 0.0031308 ? 12.92 * light :
						  1.055 * pow(light, 1 / 2.4) - 0.055;
	return (unsigned char)lround(255 * value);
}

static unsigned char *encode_grey(const Picture *picture)
{
	const size_t count = (size_t)picture->width * (size_t)picture->height;
	unsigned char *bytes = allocate(count, 1);
	for (size_t i = 0; i < count; i++) {
		const float *light = picture->light + 4 * i;
		bytes[i] = encode(0.2126 * (double)light[0] + 0.7152 * (double)light[1] +
				  0.0722 * (double)light[2]);
	}
	return bytes;
}

static unsigned char *encode_rgba(const Picture *picture)
{
	const size_t count = (size_t)picture->width * (size_t)picture->height;
	unsigned char *bytes = allocate(count, 4);
	for (size_t i = 0; i < count; i++) {
		const float *light = picture->light + 4 * i;
		const double alpha = (double)light[3];
		bytes[4 * i + 3] = (unsigned char)lround(255 * fmin(1, fmax(0, alpha)));
		for (size_t c = 0; c < 3 && bytes[4 * i + 3]; c++)
			bytes[4 * i + c] = encode((double)light[c] / alpha);
	}
	return bytes;
}

/* Returns what went wrong, or NULL. */
static const char *write_to(FILE *stream, png_image *image, const unsigned char *bytes)
{
	static char message[sizeof image->message];
	if (!stream)
		return strerror(errno);
	const int good = png_image_write_to_stdio(image, stream, 0, bytes, 0, NULL);
	snprintf(message, sizeof message, "%s", good ? "" : image->message);
	errno = 0;
	if (fclose(stream) && good)
		return strerror(errno);
	return good ? NULL : message;
}

static bool is_special(const char *file)
{
	struct stat status;
	return !stat(file, &status) && !S_ISREG(status.st_mode);
}

void picture_write(const Picture *picture, Channels channels, const char *file)
{
	png_image image = { .version = PNG_IMAGE_VERSION,
			    .width = (png_uint_32)picture->width,
			    .height = (png_uint_32)picture->height,
			    .format = channels == GREY ? PNG_FORMAT_GRAY : PNG_FORMAT_RGBA };
	unsigned char *bytes = channels == GREY ? encode_grey(picture) : encode_rgba(picture);
	const char *problem;
	if (is_special(file)) {
		problem = write_to(fopen(file, "wb"), &image, bytes);
	} else {
		const size_t size = strlen(file) + 32;
		char *temporary = allocate(size, 1);
		snprintf(temporary, size, "%s.%ld.tmp", file, (long)getpid());
		problem = write_to(fopen(temporary, "wbx"), &image, bytes);
		if (!problem && rename(temporary, file))
			problem = strerror(errno);
		if (problem)
			remove(temporary);
		free(temporary);
	}
	if (problem)
		fail("cannot write %s: %s", file, problem);
	free(bytes);
}
