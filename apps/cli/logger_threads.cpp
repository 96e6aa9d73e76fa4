// Libraries that come with OpenImageIO bring a logger, log4cplus, which starts four threads before main() begins, and
// lets the process abort when the system refuses one. Its initialisation is found here first, and left out where
// threads are scarce: nobody logs.
#include <dlfcn.h>

#include "render/workers.h"

namespace log4cplus {

__attribute__((visibility("default"), used)) void initializeLog4cplus() {
  constexpr int kEnough = 8;  // its four, and as many again, since those that were tried may not have gone yet
  using Function = void (*)();
  const auto original = reinterpret_cast<Function>(::dlsym(RTLD_NEXT, "_ZN9log4cplus20initializeLog4cplusEv"));
  if (original && etd::can_have_threads(kEnough)) original();
}

}  // namespace log4cplus
