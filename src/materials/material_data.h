// What materials are too small to hold themselves. Nothing in it moves while materials are added.
#pragma once

#include "bsdfs/coat_table.h"

namespace etd {

struct MaterialData {
  CoatTables coats;
};

}  // namespace etd
