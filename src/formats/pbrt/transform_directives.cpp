// Directives that change the current transform, and those that save and restore the state.
#include <fmt/format.h>

#include "formats/pbrt/parser.h"

namespace etd::pbrt {

namespace {

// The file gives the matrix column by column.
Mat4 matrix_of_columns(const std::vector<double>& v) {
  Mat4 m;
  for (size_t row = 0; row < 4; ++row)
    for (size_t col = 0; col < 4; ++col) m.m[row][col] = v[col * 4 + row];
  return m;
}

void identity(Parser& p, const Token&) { p.state.replace(Transform()); }

void translate(Parser& p, const Token& d) {
  if (const auto v = p.number_arguments(d, 3)) p.state.concat(Transform::translate({(*v)[0], (*v)[1], (*v)[2]}));
}

void scale(Parser& p, const Token& d) {
  if (const auto v = p.number_arguments(d, 3)) p.state.concat(Transform::scale({(*v)[0], (*v)[1], (*v)[2]}));
}

void rotate(Parser& p, const Token& d) {
  const auto v = p.number_arguments(d, 4);
  if (!v) return;
  const Vec3d axis{(*v)[1], (*v)[2], (*v)[3]};
  if (dot(axis, axis) > 0.0)
    p.state.concat(Transform::rotate((*v)[0], axis));
  else
    p.diagnostics.error(d.loc, "the axis of Rotate is zero", "Rotate takes an angle in degrees and an axis");
}

void look_at(Parser& p, const Token& d) {
  const auto v = p.number_arguments(d, 9);
  if (!v) return;
  const auto& a = *v;
  const Transform t = Transform::look_at({a[0], a[1], a[2]}, {a[3], a[4], a[5]}, {a[6], a[7], a[8]});
  if (t.is_singular())
    p.diagnostics.error(d.loc, "LookAt has no direction or no up",
                        "the eye and the point looked at must differ, and up must not be parallel to the view");
  else
    p.state.concat(t);
}

void transform(Parser& p, const Token& d) {
  if (const auto v = p.number_arguments(d, 16)) p.state.replace(Transform(matrix_of_columns(*v)));
}

void concat_transform(Parser& p, const Token& d) {
  if (const auto v = p.number_arguments(d, 16)) p.state.concat(Transform(matrix_of_columns(*v)));
}

void coordinate_system(Parser& p, const Token& d) {
  if (const auto name = p.string_argument(d, "a name")) p.coordinate_systems.set(name->value(), p.state.ctm);
}

void coord_sys_transform(Parser& p, const Token& d) {
  const auto name = p.string_argument(d, "the name of a coordinate system");
  if (!name) return;
  if (const TransformPair* found = p.coordinate_systems.find(name->value())) {
    p.state.ctm = *found;
    return;
  }
  p.diagnostics.error(name->loc, fmt::format("coordinate system \"{}\" is not defined", name->text), [&] {
    std::vector<std::string_view> names;
    for (const auto& entry : p.coordinate_systems.entries()) names.push_back(entry.first);
    const std::string_view near = nearest_name(name->value(), names);
    return names.empty()  ? "Camera defines \"camera\", WorldBegin \"world\", CoordinateSystem any other"
           : near.empty() ? fmt::format("defined here: {}", fmt::join(names, ", "))
                          : fmt::format("did you mean \"{}\"?", near);
  });
}

void active_transform(Parser& p, const Token& d) {
  const std::optional<Token> which = p.tokens.peek();
  const bool all = which && which->is_word("All");
  const bool start = which && which->is_word("StartTime"), end = which && which->is_word("EndTime");
  if (!all && !start && !end) {
    p.diagnostics.error(d.loc, "ActiveTransform takes All, StartTime or EndTime");
    return p.resynchronise();
  }
  p.tokens.next();
  p.state.start_active = all || start;
  p.state.end_active = all || end;
}

// The times hold for the whole scene, the camera included.
void transform_times(Parser& p, const Token& d) {
  const auto v = p.number_arguments(d, 2);
  if (!v) return;
  const double start = (*v)[0], end = (*v)[1];
  if (!(end > start)) {
    p.diagnostics.error(d.loc,
                        fmt::format("TransformTimes takes a start and a later end, not {:g} and {:g}", start, end));
    return;
  }
  if (p.transform_times.file >= 0)
    p.diagnostics.warning(d.loc,
                          fmt::format("this TransformTimes replaces the one at {}:{}",
                                      p.diagnostics.sources().name(p.transform_times.file), p.transform_times.line));
  if (p.scene.camera_to_world.is_moving())
    p.diagnostics.error(d.loc, "TransformTimes after a Camera that moves",
                        "it holds for the camera too: write it first");
  p.transform_times = d.loc;
  p.scene.motion_start = start;
  p.scene.motion_end = end;
}

void attribute_begin(Parser& p, const Token& d) { p.open_block(Block::Kind::kAttribute, d.loc); }
void attribute_end(Parser& p, const Token& d) { p.close_block(Block::Kind::kAttribute, d.loc); }

// pbrt-v4 keeps these as other names of AttributeBegin and AttributeEnd: they save everything.
void transform_begin(Parser& p, const Token& d) {
  p.diagnostics.note(d.loc, "TransformBegin and TransformEnd save and restore all attributes in pbrt-v4");
  p.open_block(Block::Kind::kTransform, d.loc);
}
void transform_end(Parser& p, const Token& d) { p.close_block(Block::Kind::kTransform, d.loc); }

}  // namespace

std::span<const Directive> transform_directives() {
  using Where = Directive::Where;
  static constexpr std::array<Directive, 15> kDirectives = {
      {{"Identity", Where::kAnywhere, identity},
       {"Translate", Where::kAnywhere, translate},
       {"Scale", Where::kAnywhere, scale},
       {"Rotate", Where::kAnywhere, rotate},
       {"LookAt", Where::kAnywhere, look_at},
       {"Transform", Where::kAnywhere, transform},
       {"ConcatTransform", Where::kAnywhere, concat_transform},
       {"CoordinateSystem", Where::kAnywhere, coordinate_system},
       {"CoordSysTransform", Where::kAnywhere, coord_sys_transform},
       {"ActiveTransform", Where::kAnywhere, active_transform},
       {"TransformTimes", Where::kOptions, transform_times},
       {"AttributeBegin", Where::kWorld, attribute_begin},
       {"AttributeEnd", Where::kWorld, attribute_end},
       {"TransformBegin", Where::kWorld, transform_begin},
       {"TransformEnd", Where::kWorld, transform_end}}};
  return kDirectives;
}

}  // namespace etd::pbrt
