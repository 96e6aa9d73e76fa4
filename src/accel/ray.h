// Rays and hits: the language between integrators and whatever answers ray queries.
#pragma once

#include "accel/hit.h"
#include "core/ray.h"
