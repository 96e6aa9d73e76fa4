#include "io/ply_rows.h"

#include <algorithm>
#include <cstring>

namespace etd {
namespace {

template <class T, bool kSwap>
T load(const char* at) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), at, sizeof(T));
  if constexpr (kSwap) std::reverse(raw.begin(), raw.end());
  T value;
  std::memcpy(&value, raw.data(), sizeof(T));
  return value;
}

template <class T, bool kSwap>
void convert_column(const char* data, size_t stride, size_t slot, std::span<PlyScalars> rows) {
  for (size_t i = 0; i < rows.size(); ++i) rows[i][slot] = static_cast<double>(load<T, kSwap>(data + i * stride));
}

template <bool kSwap>
void convert_column(PlyType type, const char* data, size_t stride, size_t slot, std::span<PlyScalars> rows) {
  switch (type) {
    case PlyType::kInt8:
      return convert_column<int8_t, kSwap>(data, stride, slot, rows);
    case PlyType::kUint8:
      return convert_column<uint8_t, kSwap>(data, stride, slot, rows);
    case PlyType::kInt16:
      return convert_column<int16_t, kSwap>(data, stride, slot, rows);
    case PlyType::kUint16:
      return convert_column<uint16_t, kSwap>(data, stride, slot, rows);
    case PlyType::kInt32:
      return convert_column<int32_t, kSwap>(data, stride, slot, rows);
    case PlyType::kUint32:
      return convert_column<uint32_t, kSwap>(data, stride, slot, rows);
    case PlyType::kFloat32:
      return convert_column<float, kSwap>(data, stride, slot, rows);
    case PlyType::kFloat64:
      return convert_column<double, kSwap>(data, stride, slot, rows);
  }
}

// Where the one list of faces stands among their scalars.
struct FaceLayout {
  size_t before = 0, after = 0;  // bytes
  bool has_sign = false;         // its indices
  bool is_known = false;
};

FaceLayout face_layout(const PlyPlan& plan) {
  FaceLayout layout;
  for (size_t i = 0; i < plan.slots.size(); ++i) {
    const PlyProperty& property = plan.element->properties[i];
    if (!property.count_type) {
      (layout.is_known ? layout.after : layout.before) += ply_type_bytes(property.type);
      continue;
    }
    layout.has_sign = property.type == PlyType::kInt32;
    if (layout.is_known || plan.slots[i] == PlyPlan::kSkip || ply_type_bytes(*property.count_type) != 1 ||
        (!layout.has_sign && property.type != PlyType::kUint32))
      return {};
    layout.is_known = true;
  }
  return layout;
}

template <bool kSwap>
uint64_t take_triangles(std::string_view& data, const FaceLayout& layout, uint64_t most, uint64_t vertices,
                        FaceList& faces) {
  constexpr size_t kIndex = sizeof(uint32_t);
  const size_t row = layout.before + 1 + 3 * kIndex + layout.after;
  const uint64_t count = std::min<uint64_t>(most, data.size() / row);
  const char* at = data.data();
  uint64_t done = 0;
  for (; done < count; ++done, at += row) {
    const char* const list = at + layout.before;
    if (list[0] != 3) break;
    const uint32_t a = load<uint32_t, kSwap>(list + 1), b = load<uint32_t, kSwap>(list + 1 + kIndex),
                   c = load<uint32_t, kSwap>(list + 1 + 2 * kIndex);
    if (std::max({a, b, c}) >= vertices || a == b || b == c || c == a) break;
    faces.add_triangle(a, b, c);
  }
  data.remove_prefix(done * row);
  return done;
}

}  // namespace

size_t ply_row_bytes(const PlyElement& element) {
  size_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    if (property.count_type) return 0;
    bytes += ply_type_bytes(property.type);
  }
  return bytes;
}

void convert_ply_rows(const char* data, const PlyPlan& plan, bool swap_bytes, std::span<PlyScalars> rows) {
  const size_t stride = ply_row_bytes(*plan.element);
  for (size_t i = 0; i < plan.slots.size(); ++i) {
    const PlyType type = plan.element->properties[i].type;
    if (plan.slots[i] != PlyPlan::kSkip) {
      const auto slot = static_cast<size_t>(plan.slots[i]);
      swap_bytes ? convert_column<true>(type, data, stride, slot, rows)
                 : convert_column<false>(type, data, stride, slot, rows);
    }
    data += ply_type_bytes(type);
  }
}

uint64_t take_ply_triangles(std::string_view& data, const PlyPlan& plan, bool swap_bytes, uint64_t most,
                            uint64_t vertices, FaceList& faces) {
  const FaceLayout layout = face_layout(plan);
  if (!layout.is_known) return 0;
  // A negative index is none, however many vertices there are.
  if (layout.has_sign) vertices = std::min<uint64_t>(vertices, uint64_t{1} << 31);
  return swap_bytes ? take_triangles<true>(data, layout, most, vertices, faces)
                    : take_triangles<false>(data, layout, most, vertices, faces);
}

}  // namespace etd
