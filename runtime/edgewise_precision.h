/* edgewise_precision.h - the parameters of the templates of the runtime, for the precision that
 * EW_IS_FLOAT says; included before a template, as often as needed.
 *
 * EW_REAL; EW_NAME(stem) a public function with its suffix, EW_LOCAL(stem) one of ours; EW_RUN the
 * type of a kernel; EW_WIDTH the number of virtual lanes; EW_LIST(TARGET) the kernels of a target;
 * EW_UNIT the unit roundoff, EW_TINY the smallest number. Areas between 1 / EW_SAFE and EW_SAFE are
 * far from overflow and underflow.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#undef EW_REAL
#undef EW_NAME
#undef EW_LOCAL
#undef EW_RUN
#undef EW_WIDTH
#undef EW_LIST
#undef EW_LIST_POLYNOMIALS
#undef EW_LIST_FILTERS
#undef EW_UNIT
#undef EW_TINY
#undef EW_SAFE
#if EW_IS_FLOAT
#define EW_REAL float
#define EW_NAME(stem) ew_##stem##f
#define EW_LOCAL(stem) ew_ring_##stem##f
#define EW_RUN ew_ring_runf
#define EW_WIDTH EW_LANES_FLOAT
#define EW_LIST(TARGET) EW_RINGS_##TARGET##_FLOAT
#define EW_LIST_POLYNOMIALS EW_POLYNOMIALS_FLOAT
#define EW_LIST_FILTERS EW_FILTERS_FLOAT
#define EW_UNIT 0x1p-24
#define EW_TINY 0x1p-149
#define EW_SAFE 1e18
#else
#define EW_REAL double
#define EW_NAME(stem) ew_##stem
#define EW_LOCAL(stem) ew_ring_##stem
#define EW_RUN ew_ring_run
#define EW_WIDTH EW_LANES
#define EW_LIST(TARGET) EW_RINGS_##TARGET##_DOUBLE
#define EW_LIST_POLYNOMIALS EW_POLYNOMIALS_DOUBLE
#define EW_LIST_FILTERS EW_FILTERS_DOUBLE
#define EW_UNIT 0x1p-53
#define EW_TINY 0x1p-1074
#define EW_SAFE 1e180
#endif
