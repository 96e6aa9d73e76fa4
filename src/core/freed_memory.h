// Memory that was freed and that the allocator keeps.
#pragma once

#include <malloc.h>

namespace etd {

// Gives the system back what was freed, as after loading: what is needed next is then all that is added.
inline void return_freed_memory() { ::malloc_trim(0); }

}  // namespace etd
