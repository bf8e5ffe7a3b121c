/* check.h - the test helper of this folder: named tests, one line each, and a seeded generator.
 *
 *     check_start(argc, argv);            argv[1], if given, is the seed
 *     check_begin("area %s", target);     opens a test and resets the generator
 *     expect(a == b, "a is %g", a);       any number of times; the first failure is kept
 *     check_end();                        prints `ok NAME` or `not ok NAME: detail`
 *     return check_finish();              prints `N passed, N failed`; 1 if a test failed
 *
 * The generator is reset by every test from the seed and the test's name, so a test draws the
 * same numbers whichever tests run before it, and a failure prints the seed to run it again with.
 * (Two draws in one argument list would come in an order that is the compiler's.)
 * A crash inside a test is caught, charged to that test and ends the program.
 */
#ifndef CHECK_H
#define CHECK_H

#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct {
	uint64_t seed, state;
	const char *program;
	char name[120];
	char detail[600];
	bool failed;            /* the open test has failed */
	int passed, failures;   /* closed tests */
} check;

static inline uint64_t random_bits(void)
{
	/* splitmix64: a counter and a mix */
	uint64_t z = check.state += 0x9e3779b97f4a7c15u;
	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
	return z ^ (z >> 31);
}

/* Uniform in [low, high), 53 random bits. */
static inline double random_real(double low, double high)
{
	return low + (high - low) * ((double)(random_bits() >> 11) * 0x1p-53);
}

/* Uniform in low..high, both included. */
static inline int random_int(int low, int high)
{
	return low + (int)(random_bits() % (uint64_t)(high - low + 1));
}

/* Uniform in (-1, 1) times a random power of two, 2^low to 2^high. */
static inline double random_scaled(int low, int high)
{
	const double v = random_real(-1, 1);
	return ldexp(v, random_int(low, high));
}

/* Of either sign, and of size scale/2 to scale. */
static inline double random_sized(double scale)
{
	const double v = random_real(0.5, 1) * scale;
	return random_int(0, 1) ? v : -v;
}

static inline void check_crash(int number)
{
	char text[400];
	const int length = snprintf(text, sizeof text,
		"not ok %s: stopped by signal %d (again: %s %llu)\n%d passed, %d failed\n",
		check.name, number, check.program, (unsigned long long)check.seed, check.passed,
		check.failures + 1);
	if (write(STDOUT_FILENO, text, (size_t)length) < 0)
		_exit(2);
	_exit(1);
}

static inline void check_start(int argc, char **argv)
{
	setvbuf(stdout, NULL, _IONBF, 0);
	check.program = argv[0];
	check.seed = argc > 1 ? strtoull(argv[1], NULL, 0) : 1;
	signal(SIGSEGV, check_crash);
	signal(SIGBUS, check_crash);
	signal(SIGILL, check_crash);
	signal(SIGFPE, check_crash);
	signal(SIGABRT, check_crash);
}

__attribute__((format(printf, 1, 2)))
static inline void check_begin(const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	vsnprintf(check.name, sizeof check.name, format, arguments);
	va_end(arguments);
	check.failed = false;
	check.state = check.seed;
	for (const char *p = check.name; *p; p++)
		check.state = (check.state ^ (unsigned char)*p) * 0x100000001b3u;
}

/* Keeps the first failure of the open test; returns ok. */
__attribute__((format(printf, 2, 3)))
static inline bool expect(bool ok, const char *format, ...)
{
	if (ok || check.failed)
		return ok;
	va_list arguments;
	va_start(arguments, format);
	vsnprintf(check.detail, sizeof check.detail, format, arguments);
	va_end(arguments);
	check.failed = true;
	return false;
}

static inline void check_end(void)
{
	if (check.failed) {
		check.failures++;
		printf("not ok %s: %s (again: %s %llu)\n", check.name, check.detail, check.program,
			(unsigned long long)check.seed);
	} else {
		check.passed++;
		printf("ok %s\n", check.name);
	}
}

static inline int check_finish(void)
{
	printf("%d passed, %d failed\n", check.passed, check.failures);
	return check.failures > 0;
}

#endif
