#define EW_IMPLEMENTATION
#include "edgewise.h"
