/* dispatch.c - which targets the runtime finds on simulated x86-64 CPUs, and what can be forced.
 *
 * The runtime's file is included as MSVC takes it: it asks the CPU by __cpuidex and _xgetbv, which
 * are simulated here. A CPU is a row: the highest leaf, ECX of leaf 1, EBX of leaf 7, XCR0. XGETBV
 * where the system has not enabled it would be an illegal instruction. tests/msvc.sh builds and
 * runs this, because an empty intrin.h must lie in the way and __clang__ must not be defined.
 */
#include "check.h"

#define _MSC_VER 1930
#define _M_X64 100

enum { FMA3 = 1 << 12, SAVES = 1 << 27, AVX1 = 1 << 28, FULL = FMA3 | SAVES | AVX1 };
enum { V2 = 1 << 5, V512 = 1 << 16, WIDE = V2 | V512 };

typedef struct { int leaves, features, wide; unsigned xcr0; const char *targets; } Cpu;

static const Cpu cpus[] = {
	{ 0, FULL, WIDE, 0xe7, "portable" },
	{ 1, FULL, WIDE, 0xe7, "portable fma" },
	{ 6, FULL, WIDE, 0xe7, "portable fma" },
	{ 7, 0, WIDE, 0xe7, "portable" },
	{ 7, FULL & ~FMA3, WIDE, 0xe7, "portable" },
	{ 7, FULL & ~SAVES, WIDE, 0xe7, "portable" },
	{ 7, FULL & ~AVX1, WIDE, 0xe7, "portable" },
	{ 7, FULL, WIDE, 0x1, "portable" },
	{ 7, FULL, WIDE, 0x3, "portable" },
	{ 7, FULL, WIDE, 0x5, "portable" },
	{ 7, FULL, 0, 0xe7, "portable fma" },
	{ 7, FULL, ~WIDE, 0xe7, "portable fma" },
	{ 7, FULL, V2, 0xe7, "portable fma avx2" },
	{ 7, FULL, WIDE, 0x7, "portable fma avx2" },
	{ 7, FULL, WIDE, 0x67, "portable fma avx2" },
	{ 7, FULL, WIDE, 0xa7, "portable fma avx2" },
	{ 7, FULL, WIDE, 0xc7, "portable fma avx2" },
	{ 7, FULL, V512, 0xe7, "portable fma" },
	{ 7, FULL, WIDE, 0xe7, "portable fma avx2 avx512" },
	{ 32, -1, -1, 0xffffffffu, "portable fma avx2 avx512" },
};

static const Cpu *cpu;
static bool illegal;

/* Beyond its highest leaf a CPU answers anything. */
static void __cpuidex(int r[4], int leaf, int subleaf)
{
	memset(r, 0, 4 * sizeof *r);
	if (leaf == 0)
		r[0] = cpu->leaves;
	else if (leaf == 1)
		r[2] = cpu->features;
	else if (leaf == 7 && subleaf == 0)
		r[1] = cpu->wide;
}

static unsigned long long _xgetbv(unsigned index)
{
	illegal |= !(cpu->features & SAVES) || index != 0;
	return cpu->xcr0;
}

#include "edgewise_dispatch.c"

static const char *names_of(unsigned targets)
{
	static char text[100];
	text[0] = 0;
	for (unsigned bit = 1; bit; bit *= 2)
		if (targets & bit) {
			strcat(text, *text ? " " : "");
			strcat(text, ew_target_name(bit));
		}
	return text;
}

/* All sets of the eight lowest bits, and all single bits: none and one of ours pass. */
static void expect_forced(unsigned targets)
{
	const unsigned best = ew_cpu_target();
	expect((best & targets) == best && best * 2 > targets, "%#x is used", best);
	for (unsigned i = 0; i < 256 + 32; i++) {
		const unsigned wish = i < 256 ? i : 1u << (i - 256), before = ew_cpu_target();
		const bool fine = (wish & targets) == wish && (wish & (wish - 1)) == 0;
		expect(ew_use_target(wish) == (fine ? EW_OK : EW_UNSUPPORTED),
			"%#x is %s", wish, fine ? "refused" : "not refused");
		expect(ew_cpu_target() == (!fine ? before : wish ? wish : best),
			"%#x: %#x is used, before it was %#x", wish, ew_cpu_target(), before);
	}
	expect(ew_use_target(0) == EW_OK && ew_cpu_target() == best, "0 is not the best target");
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	for (size_t i = 0; i < sizeof cpus / sizeof *cpus; i++) {
		cpu = &cpus[i];
		ew_cpu_available = 0;
		illegal = false;
		check_begin("CPU with %d leaves, %08x, %08x, XCR0 %x", cpu->leaves,
			(unsigned)cpu->features, (unsigned)cpu->wide, cpu->xcr0);
		expect(strcmp(names_of(ew_targets()), cpu->targets) == 0, "finds %s, not %s",
			names_of(ew_targets()), cpu->targets);
		expect(!illegal, "XGETBV is not enabled, but asked");
		expect_forced(ew_targets());
		check_end();
	}
	return check_finish();
}
