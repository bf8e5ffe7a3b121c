/* edgewise_runtime.h - what the files of the runtime share; not for users.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#ifndef EDGEWISE_RUNTIME_H
#define EDGEWISE_RUNTIME_H

#include "edgewise.h"
#include "edgewise_kernels.h"

enum {
	EW_LANES = 8,        /* virtual lanes of the definition, double */
	EW_LANES_FLOAT = 16,
	EW_BLOCK = 1024,     /* items between two flushes of float lanes to double, by definition */
	EW_STAGE = 256       /* vertices moved or gathered at a time; not part of the definition */
};

#ifdef __cplusplus
extern "C" {
#endif

unsigned ew_cpu_target(void);  /* the forced target, or the best one: one bit */

#ifdef __cplusplus
}
#endif

#endif
