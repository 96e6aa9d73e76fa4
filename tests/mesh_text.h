// Reads mesh files that tests hold as text, or as the bytes of it.
#pragma once

#include <gtest/gtest.h>

#include <string_view>

#include "io/mesh.h"
#include "temp_folder.h"

namespace etd {

using MeshReader = MeshResult (*)(const std::filesystem::path& path, const Limits& limits);

inline MeshResult read_mesh_text(MeshReader read, std::string_view text) {
  const TempFolder folder;
  return read(folder.write("mesh", text), {});
}

// A broken file has this one problem.
inline void expect_only_problem(const MeshResult& result, std::string_view problem) {
  EXPECT_FALSE(result.mesh.has_value()) << problem;
  ASSERT_EQ(result.problems.size(), 1u) << problem;
  EXPECT_EQ(result.problems[0], problem);
}

}  // namespace etd
