/* edgewise_dispatch.c - which targets this build has, which this CPU runs, and which one is used.
 *
 * On x86 the CPU is asked by CPUID, and by XGETBV whether the operating system saves the wide
 * registers: FMA3 works on them. The answer is cached in one word, written with the same value by
 * whichever thread comes first.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#include "edgewise_runtime.h"

static const struct { unsigned bit; const char *name; } ew_cpu_names[] = {
	{ EW_PORTABLE, "portable" }, { EW_FMA, "fma" }, { EW_AVX2, "avx2" },
	{ EW_AVX512, "avx512" }, { EW_NEON, "neon" }, { EW_WASM128, "wasm128" },
};
enum { EW_CPU_NAMES = (int)(sizeof ew_cpu_names / sizeof *ew_cpu_names) };

static unsigned ew_cpu_available, ew_cpu_forced;       /* 0: not asked yet; 0: not forced */

#if defined(__GNUC__) || defined(__clang__)
#define EW_CPU_LOAD(word) __atomic_load_n(&(word), __ATOMIC_RELAXED)
#define EW_CPU_STORE(word, value) __atomic_store_n(&(word), value, __ATOMIC_RELAXED)
#else                                          /* aligned words do not tear */
#define EW_CPU_LOAD(word) (*(volatile unsigned *)&(word))
#define EW_CPU_STORE(word, value) (*(volatile unsigned *)&(word) = (value))
#endif

#if EW_X86
#if defined(_MSC_VER) && !defined(__clang__)
#include <intrin.h>
static void ew_cpu_id(unsigned leaf, unsigned r[4])
{
	__cpuidex((int *)r, (int)leaf, 0);
}
static unsigned ew_cpu_xcr0(void)
{
	return (unsigned)_xgetbv(0);
}
#else
static void ew_cpu_id(unsigned leaf, unsigned r[4])
{
	__asm__("cpuid" : "=a"(r[0]), "=b"(r[1]), "=c"(r[2]), "=d"(r[3]) : "a"(leaf), "c"(0));
}
static unsigned ew_cpu_xcr0(void)
{
	unsigned low, high;
	__asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
	return low;
}
#endif

static unsigned ew_cpu_detect(void)
{
	enum { FMA = 1u << 12, OSXSAVE = 1u << 27, AVX = 1u << 28 };
	enum { AVX2 = 1u << 5, AVX512 = AVX2 | 1u << 16 };     /* F; compilers imply AVX2 with it */
	enum { YMM = 0x6, ZMM = 0xe6 };    /* register state that the system saves, in XCR0 */
	unsigned r[4] = { 0, 0, 0, 0 }, found = EW_PORTABLE, leaves;
	ew_cpu_id(0, r);
	leaves = r[0];
	if (leaves < 1)
		return found;
	ew_cpu_id(1, r);
	if ((r[2] & (FMA | OSXSAVE | AVX)) != (FMA | OSXSAVE | AVX) || (ew_cpu_xcr0() & YMM) != YMM)
		return found;
	found |= EW_BUILD_FMA ? EW_FMA : 0;
	if (leaves < 7)
		return found;
	ew_cpu_id(7, r);
	found |= EW_BUILD_AVX2 && r[1] & AVX2 ? EW_AVX2 : 0;
	found |= EW_BUILD_AVX512 && (r[1] & AVX512) == AVX512 && (ew_cpu_xcr0() & ZMM) == ZMM
		? EW_AVX512 : 0;
	return found;
}
#else
static unsigned ew_cpu_detect(void)
{
	return EW_PORTABLE | (EW_BUILD_FMA ? EW_FMA : 0) | (EW_BUILD_NEON ? EW_NEON : 0)
		| (EW_BUILD_WASM128 ? EW_WASM128 : 0);
}
#endif

unsigned ew_targets(void)
{
	unsigned known = EW_CPU_LOAD(ew_cpu_available);
	if (!known) {
		known = ew_cpu_detect();
		EW_CPU_STORE(ew_cpu_available, known);
	}
	return known;
}

unsigned ew_cpu_target(void)
{
	unsigned forced = EW_CPU_LOAD(ew_cpu_forced);
	if (forced)
		return forced;
	unsigned best = EW_PORTABLE;               /* bits stand in the order of speed */
	while (best * 2 <= ew_targets())
		best *= 2;
	return best;
}

int ew_use_target(unsigned target)
{
	if (target & (target - 1) || (target & ew_targets()) != target)
		return EW_UNSUPPORTED;
	EW_CPU_STORE(ew_cpu_forced, target);
	return EW_OK;
}

const char *ew_target_name(unsigned target)
{
	for (int i = 0; i < EW_CPU_NAMES; ++i)
		if (ew_cpu_names[i].bit == target)
			return ew_cpu_names[i].name;
	return "unknown";
}

const char *ew_version(void)
{
	return EW_VERSION;
}
