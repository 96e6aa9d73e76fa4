// The one macro of the project: marks a function over values and const data that may one day be compiled for a GPU
// too. Such a function has no heap, virtual call, exception, lock or global.
#pragma once

#ifdef __CUDACC__
#define ETD_FN __host__ __device__ inline
#else
#define ETD_FN inline
#endif
