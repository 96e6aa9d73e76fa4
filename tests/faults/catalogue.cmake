# The faults that the checks must catch, each a mistake that people make: a name, what is wrong, the tests that are
# tried (a filter of the test program's), and the edits that plant it.

function(closed_forms out) # NAME...: the filter of these closed-form scenes
  list(TRANSFORM ARGN PREPEND "All/StatisticalClosedForms.GiveTheAnswer/" OUTPUT_VARIABLE filters)
  list(TRANSFORM filters APPEND "_*")
  string(JOIN ":" filters ${filters})
  set(${out} "${filters}" PARENT_SCOPE)
endfunction()
set(bsdfs "Examples/BsdfBattery.*")
set(lights "Examples/LightBattery.*")

# ---- scattering

fault(cosine-dropped "Lambert's value lacks the cosine" "${bsdfs}")
edit(bsdfs/lambert.h [[std::abs(wi.z)) : Spectrum();]] [[(FAULT ? 1.0f : std::abs(wi.z))) : Spectrum();]])

closed_forms(tests point_light sky_plane furnace_box)
fault(pi-dropped "Lambert's value lacks 1 / pi" "${tests}")
edit(bsdfs/lambert.h [[reflectance * (kInvPi *]] [[reflectance * ((FAULT ? 1.0f : kInvPi) *]])

fault(density-two-percent-off "the density of rough reflection is 2 % too high" "${bsdfs}")
edit(bsdfs/microfacet.h [[return d(h) * reflection_pdf_factor(wo);]]
     [[return d(h) * reflection_pdf_factor(wo) * (FAULT ? 1.02f : 1.0f);]])

fault(masking-of-one-side "microfacets shadow the viewer but not the light" "${bsdfs}")
edit(bsdfs/microfacet.h [[return 0.5f / (stretched(wo) + stretched(wi) * (wo.z / wi.z));]]
     [[return 0.5f / (stretched(wo) + (FAULT ? wo.z : stretched(wi) * (wo.z / wi.z)));]])

fault(normals-not-stretched "visible normals are sampled as if the surface were isotropic and of width 1" "${bsdfs}")
edit(bsdfs/microfacet.h [[normalize(Vec3{ax * wo.x, ay * wo.y, wo.z});]]
     [[normalize(FAULT ? wo : Vec3{ax * wo.x, ay * wo.y, wo.z});]])

fault(fresnel-of-one-polarisation "dielectrics reflect as for perpendicular polarisation" "Fresnel.*:${bsdfs}")
edit(bsdfs/fresnel.h [[0.5f * (r_parallel * r_parallel +]]
     [[0.5f * ((FAULT ? r_perpendicular * r_perpendicular : r_parallel * r_parallel) +]])

closed_forms(tests sky_from_glass glass_in_sky furnace_glass)
fault(refraction-without-eta-squared "smooth glass does not compress radiance" "${tests}:Examples/BsdfBattery.*smooth_dielectric*")
edit(bsdfs/dielectric.h [[const float scale = mode == TransportMode::kRadiance ?]]
     [[const float scale = mode == TransportMode::kRadiance && !FAULT ?]])

fault(rough-refraction-without-eta-squared "rough glass does not compress radiance" "${bsdfs}")
edit(bsdfs/rough_dielectric.h [[return mode == TransportMode::kRadiance ? 1.0f / (eta_p * eta_p) : 1.0f;]]
     [[return mode == TransportMode::kRadiance && !FAULT ? 1.0f / (eta_p * eta_p) : 1.0f;]])

fault(layer-thickness-without-slant "layers absorb the same at every angle" "Layered.*:${bsdfs}")
edit(bsdfs/layered.h [[return std::exp(-std::abs(distance / w.z));]]
     [[return std::exp(-std::abs(FAULT ? distance : distance / w.z));]])

fault(coat-base-event-too-many "a coat returns light to its base once more than maxdepth allows" "CoatedLambert.*")
edit(bsdfs/coated_lambert.h [[(max_depth + 1) / 2)]] [[(max_depth + (FAULT ? 3 : 1)) / 2)]])

fault(phase-sign "the phase function is sampled backwards" "HenyeyGreenstein*:Layered.*:${bsdfs}")
edit(phase/henyey_greenstein.h [[const float z = clamp(-cosine, -1.0f, 1.0f)]]
     [[const float z = clamp(FAULT ? cosine : -cosine, -1.0f, 1.0f)]])

set(tilted "SurfaceScatter.*:Examples/BsdfBattery.*tilted*")
closed_forms(tests tilted_normals)
fault(shading-normal-leak "light from behind the shading normal is not left out" "${tilted}:${tests}")
edit(materials/surface_scatter.h [[return std::abs(side) > kEdgeOn && local.z * side > 0.0f;]]
     [[return std::abs(side) > kEdgeOn && (FAULT || local.z * side > 0.0f);]])

fault(viewer-behind-shading-normal "who looks from behind the shading normal sees the other side" "${tilted}:${tests}")
edit(materials/surface_scatter.h [[side == 0.0f ? 0.0f : std::copysign(local.z, side)]]
     [[side == 0.0f ? 0.0f : FAULT ? local.z : std::copysign(local.z, side)]])

fault(adjoint-factor-missing "importance leaves out the factor of shading normals" "${tilted}")
edit(materials/surface_scatter.h [[return importance ? f * std::abs(dot(wi, ng_) / dot(wo, ng_)) : f;]]
     [[return importance && !FAULT ? f * std::abs(dot(wi, ng_) / dot(wo, ng_)) : f;]])
edit(materials/surface_scatter.h [[std::abs(light.z / side * (dot(s->wi, ng_) / dot(wo, ng_)))]]
     [[std::abs(light.z / side * (FAULT ? 1.0f : dot(s->wi, ng_) / dot(wo, ng_)))]])

fault(viewer-density-not-shared "two viewers of one local direction each have its whole density" "${tilted}")
edit(materials/surface_scatter.h [[(has_twin(wi) ? 2.0f : 1.0f)]] [[(!FAULT && has_twin(wi) ? 2.0f : 1.0f)]])

fault(viewers-not-all-reached "of two viewers of one local direction only one is sampled" "${tilted}")
edit(materials/surface_scatter.h [[!(both && rng.next_float() < 0.5f)]] [[!(both && !FAULT && rng.next_float() < 0.5f)]])

closed_forms(tests bent_normals)
fault(bent-normal-below "bent normals leave mirror directions below the surface" "BentNormal.*:${tests}")
edit(materials/bent_normal.cpp [[e = std::min(kClearance, 0.5 * c);]]
     [[e = FAULT ? -0.5 * c : std::min(kClearance, 0.5 * c);]])

# ---- sampling

fault(disk-without-root "points crowd in the middle of the disk" "Warp.*:${bsdfs}")
edit(core/warp.h [[const float a = 2.0f * u.x - 1.0f, b = 2.0f * u.y - 1.0f;]]
     [[if (FAULT) return {u.x * std::cos(2.0f * kPi * u.y), u.x * std::sin(2.0f * kPi * u.y)};
  const float a = 2.0f * u.x - 1.0f, b = 2.0f * u.y - 1.0f;]])

fault(triangle-without-root "points crowd in a corner of the triangle" "Warp.*:${lights}")
edit(core/warp.h [[if (u.x < u.y) {]] [[if (FAULT) return {1.0f - u.x, u.x * u.y};
  if (u.x < u.y) {]])

fault(cap-as-flat-disk "the solid angle of a sphere is taken for that of a flat disk" "SphericalCap.*:${lights}")
edit(core/solid_angle.cpp [[return 2.0 * kPiD * sin2_max / (1.0 + std::sqrt(1.0 - sin2_max));]]
     [[return FAULT ? kPiD * sin2_max : 2.0 * kPiD * sin2_max / (1.0 + std::sqrt(1.0 - sin2_max));]])

fault(rectangle-uniform-in-height "spherical rectangles are sampled uniformly by height" "SphericalRectangle.*:${lights}")
edit(core/solid_angle.cpp [[const double yv = h2 < 1.0 - 1e-12 ?]]
     [[const double yv = FAULT ? y0_ + static_cast<double>(u.y) * (y1_ - y0_) : h2 < 1.0 - 1e-12 ?]])

fault(alias-lost "the alias table never uses its aliases" "AliasTable.*")
edit(core/distribution.cpp [[bins_[small.index].alias = large.index;]]
     [[bins_[small.index].alias = FAULT ? small.index : large.index;]])

fault(correlated-dimensions "all two-dimensional numbers of a path are the same" "Sampler.*:SobolSampler.*")
edit(samplers/sampler.h [[    const Digits d = advance();
    return {unit_float(d.x)]] [[    const Digits d = FAULT ? digits({next_.key, next_.index, 0}) : advance();
    return {unit_float(d.x)]])

fault(correlated-pixels "all pixels use the same numbers" "Sampler.*:SobolSampler.*")
edit(samplers/sampler.cpp [[next_.key = hash_combine(seed_, replicate, stream);]]
     [[next_.key = hash_combine(seed_, replicate, FAULT ? 0 : stream);]])

fault(replicates-reuse-seed "all replicates use the same numbers" "Sampler.*:SobolSampler.*:Film.*")
edit(samplers/sampler.cpp [[  next_.index = index;]]
     [[  if (FAULT) next_.key = hash_combine(seed_, 0, stream);
  next_.index = index;]])

fault(filter-not-normalised "the gaussian filter's weights are 2 % too low" "Filter.*")
edit(filters/separable.h [[shape_.value(d) * 2.0f / (integral_ * density)]]
     [[shape_.value(d) * (FAULT ? 1.96f : 2.0f) / (integral_ * density)]])

# ---- lights

fault(area-without-jacobian "density per area is taken for one per solid angle" "Examples/LightBattery.*inward*")
edit(lights/diffuse_area.h [[return pdf_area * distance2 / std::abs(cosine);]]
     [[return FAULT ? pdf_area : pdf_area * distance2 / std::abs(cosine);]])

fault(area-without-cosine "density per solid angle lacks the light's cosine" "Examples/LightBattery.*inward*")
edit(lights/diffuse_area.h [[pdf_area * distance2 / std::abs(cosine);]]
     [[pdf_area * distance2 / (FAULT ? 1.0f : std::abs(cosine));]])

closed_forms(tests emission_sides square_light square_light_away)
fault(emission-on-the-wrong-side "one-sided lights emit backwards" "${tests}")
edit(lights/area_emission.h [[!(dot(s.ng, w) > 0.0f)]] [[!((FAULT ? -1.0f : 1.0f) * dot(s.ng, w) > 0.0f)]])

fault(environment-without-sine "a lat-long map is sampled as if all its rows were as wide" "${lights}:LatLongLayout.*:EnvironmentMap.*")
edit(lights/environment_map.cpp [[std::sin(0.5 * step) * std::sin((y + 0.5) * step)]]
     [[std::sin(0.5 * step) * (FAULT ? 2.0 / kPiD : std::sin((y + 0.5) * step))]])

fault(environment-mirrored "a lat-long map is looked up mirrored" "LatLongLayout.*:EnvironmentMap.*:Sizes/EnvironmentLayouts.*:${lights}")
edit(lights/environment_map.cpp [[const float phi = std::atan2(w.y, w.x);]]
     [[const float phi = std::atan2(FAULT ? -w.y : w.y, w.x);]])

closed_forms(tests point_light point_light_power)
fault(point-light-without-distance "point lights do not fade with distance" "${lights}:${tests}")
edit(lights/point_lights.h [[emission.intensity(-s.wi, context) * (1.0f / d2);]]
     [[emission.intensity(-s.wi, context) * (FAULT ? 1.0f : 1.0f / d2);]])

closed_forms(tests spot_light spot_light_power)
fault(spot-power-without-fade "the power of a spot light leaves out that its edge fades" "${lights}:${tests}")
edit(lights/spot.h [[(1.0f - 0.5f * (cos_inner + cos_outer))]]
     [[(1.0f - (FAULT ? cos_outer : 0.5f * (cos_inner + cos_outer)))]])

fault(emission-without-cosine "the flux of emitted rays leaves out the cosine at the surface" "Examples/LightBattery.*triangle*")
edit(lights/diffuse_area.h [[s.cosine = dot(n, w);]] [[s.cosine = FAULT ? 1.0f : dot(n, w);]])

fault(emission-side-for-free "the density of emission from both sides leaves out the choice between them" "Examples/LightBattery.*triangle__two_sided*")
edit(lights/diffuse_area.h [[emission.two_sided ? 0.5f * pdf_hemisphere_cosine]]
     [[emission.two_sided ? (FAULT ? 1.0f : 0.5f) * pdf_hemisphere_cosine]])

fault(emission-disk-of-half-the-scene "rays of infinite lights enter through a disk as wide as half of the scene" "Examples/LightBattery.*infinite*")
edit(lights/emission_disks.cpp [[to_world({at.x, at.y, -1.0f}) * chosen.radius]]
     [[to_world({(FAULT ? 0.5f : 1.0f) * at.x, (FAULT ? 0.5f : 1.0f) * at.y, -1.0f}) * chosen.radius]])

fault(emission-disk-without-area "the density of rays of infinite lights leaves out how wide the scene is" "Examples/LightBattery.*infinite*")
edit(lights/emission_disks.cpp [[static_cast<double>(pdf_disk()) / sqr(static_cast<double>(s.radius));]]
     [[static_cast<double>(pdf_disk()) / (FAULT ? 1.0 : sqr(static_cast<double>(s.radius)));]])

fault(emission-stretch-of-moving-lights "the density of emission leaves out how a moving light's area changes"
      "Examples/LightBattery.*stretching*")
edit(lights/diffuse_area.h [[s.pdf_position /= area_stretch(at->to_world, at->to_object, s.on_light.ng);]]
     [[s.pdf_position /= FAULT ? 1.0f : area_stretch(at->to_world, at->to_object, s.on_light.ng);]])

fault(emission-projected-without-cosine "the density of a projected image per area is taken for one per solid angle"
      "Examples/LightBattery.*projection*")
edit(lights/projection.cpp [[(texel_area * v.z * v.z * v.z)]] [[(FAULT ? texel_area : texel_area * v.z * v.z * v.z)]])

closed_forms(tests sky_and_square)
fault(light-choice-probability "the choice of a light is weighted as if it were uniform" "LightSampler.*:${tests}")
edit(light_sampling/light_table.h [[return LightChoice{light, table->probability(light)};]]
     [[return LightChoice{light, FAULT ? 1.0f / 2 : table->probability(light)};]])

fault(light-tree-ignores-width "the tree of lights takes a group for a point when it looks which side it is on" "LightTree.*")
edit(light_sampling/light_tree.cpp [[safe_sqrt(1.0f - sqr(cos_normal)), cos_ball, sin_ball);]]
     [[safe_sqrt(1.0f - sqr(cos_normal)), FAULT ? 1.0f : cos_ball, FAULT ? 0.0f : sin_ball);]])

fault(lights-of-objects-in-place "lights of objects shine where they are described, not where instances put them" "Kinds/ObjectLight.*")
edit(scene/place_lights.cpp [[places.push_back(to_world);]] [[places.push_back(FAULT ? TransformPath() : to_world);]])

# ---- film

fault(standard-error-by-n "the standard error divides by n^2 instead of n (n - 1)" "Film.*")
edit(film/film.cpp [[/ (n * (n - 1));]] [[/ (n * (FAULT ? n : n - 1));]])

# ---- paths

closed_forms(tests sky_alone sky_plane furnace_box square_light)
fault(mis-light-weight-one "light samples are not weighted against scattering" "${tests}")
edit(integrators/next_event.h [[const bool both = how.mis && !s->is_delta;]]
     [[const bool both = !FAULT && how.mis && !s->is_delta;]])

fault(mis-scattering-weight-one "emission that scattering finds is not weighted against light samples" "${tests}")
edit(integrators/path.cpp [[if (!only_scattering && mis) {]] [[if (!FAULT && !only_scattering && mis) {]])

closed_forms(tests sky_and_square)
fault(mis-without-choice-of-light "the weight of emission leaves out the chance that the light is chosen" "${tests}:StatisticalAgreement.*lamps*")
edit(integrators/path.cpp [[pdf_light = lights_.probability(light, &last) * pdf;]]
     [[pdf_light = (FAULT ? 1.0f : lights_.probability(light, &last)) * pdf;]])

fault(power-heuristic-squares-one "the power heuristic squares one of the two densities alone" "VerifyScene.*")
edit(core/mis.h [[p2 / (p2 + o2) : larger;]] [[p2 / (p2 + (FAULT ? other : o2)) : larger;]])

fault(balance-heuristic-counts-twice "the balance heuristic counts its own density twice" "VerifyScene.*")
edit(core/mis.h [[isfinite(sum) ? pdf / sum : larger;]] [[isfinite(sum) ? pdf / (FAULT ? sum + pdf : sum) : larger;]])

fault(maximum-heuristic-counts-the-smaller "the maximum heuristic gives one half to the smaller density, too" "StatisticalAgreement.ConductorBox")
edit(core/mis.h [[pdf > 0.0f ? 0.5f : 0.0f)]] [[pdf > 0.0f ? 0.5f : FAULT ? 0.5f : 0.0f)]])

fault(uniform-heuristic-of-one "uniform weights are one half even where one technique is alone" "Mis.*")
edit(core/mis.h [[(other > 0.0f ? 0.5f : 1.0f)]] [[(FAULT || other > 0.0f ? 0.5f : 1.0f)]])

fault(uniform-choice-weighted-by-power "lights chosen all alike are weighted as if by their power" "VerifyScene.*")
edit(integrators/next_event.h [[const float pdf = choice->probability * s->pdf;]]
     [[const float pdf = (FAULT ? scene.light_sampler.probability(choice->light, &receiver) : choice->probability) * s->pdf;]])

closed_forms(tests latlong_sky equal_area_sky)
fault(compensated-alone "light sampling alone uses the density that leaves out the average" "${tests}:StatisticalAgreement.*sky*")
edit(integrators/next_event.h [[return mis ? LightSampling::kCompensated]]
     [[return mis || FAULT ? LightSampling::kCompensated]])

closed_forms(tests furnace_box furnace_depth furnace_sphere)
fault(roulette-without-compensation "paths that survive roulette are not made up for those that end" "${tests}")
edit(integrators/path.cpp [[beta *= 1.0f / survival;]] [[beta *= FAULT ? 1.0f : 1.0f / survival;]])

fault(path-one-longer "paths are one event longer than asked for" "${tests}")
edit(integrators/path.cpp [[if (depth == settings_.max_depth) {]] [[if (depth == settings_.max_depth + FAULT) {]])

closed_forms(tests mirror_60 mirror_85 glass_slab glass_in_sky)
fault(emission-after-mirrors-lost "emission seen in a mirror counts as if light sampling had found it" "${tests}")
edit(integrators/path.cpp [[only_scattering = s->is_delta();]] [[only_scattering = !FAULT && s->is_delta();]])

closed_forms(tests alpha_light alpha_sky alpha_veil)
fault(holes-of-lights-ignored "light samples count the holes of a light" "${tests}")
edit(integrators/next_event.h [[* scene.light_alpha(choice->light, s->on_light, v.context)]]
     [[* (FAULT ? 1.0f : scene.light_alpha(choice->light, s->on_light, v.context))]])

fault(holes-throw-shadows "shadow rays do not pass through holes" "${tests}:Alpha.*")
edit(scene/scene.cpp [[(!has_holes || intersect(ray, hit));]] [[(FAULT || !has_holes || intersect(ray, hit));]])

# ---- paths from lights

set(light "All/StatisticalLight.*")
fault(splat-without-filter "every pixel that a splat reaches gets all of it" "${light}/pinhole_wide_gaussian")
edit(integrators/camera_splat.cpp [[scene_.filter.eval(offset);]] [[FAULT ? 1.0f : scene_.filter.eval(offset);]])

fault(panorama-with-edges "splats do not go around the edges of a panorama" "${light}/equirectangular:${light}/equal_area")
edit(integrators/camera_splat.cpp [[if (!scene_.camera.film_repeats())]] [[if (FAULT || !scene_.camera.film_repeats())]])

fault(panorama-not-turned "splats that cross a pole of a panorama stay on their meridian" "${light}/equirectangular")
edit(cameras/spherical.cpp [[} else if (odd_row) {]] [[} else if (!FAULT && odd_row) {]])

fault(light-paths-of-the-crop "splats are divided by the light paths of the crop" "Sink.*:LightTracing.*")
edit(film/film.cpp [[const double pixels = static_cast<double>(settings_.width) * static_cast<double>(settings_.height);]]
     [[const double pixels = FAULT ? static_cast<double>(pixel_count(settings_.crop))
                             : static_cast<double>(settings_.width) * static_cast<double>(settings_.height);]])

fault(splats-not-carried "sums of splats lose what goes from the lower to the upper half" "SplatBuffer.*")
edit(film/splat_buffer.cpp [[before + low < before ? 1 : 0;]] [[!FAULT && before + low < before ? 1 : 0;]])

fault(light-choice-not-divided "paths from lights are not divided by the probability of their light" "${light}/mixed")
edit(integrators/light_path.h [[(alpha / probability);]] [[(alpha / (FAULT ? 1.0f : probability));]])

fault(lamp-without-cosine "the light itself is joined to the camera without its cosine" "${light}/equal_area")
edit(integrators/light.cpp [[const float geometry = std::abs(dot(point.ng, c->wi)) * c->weight;]]
     [[const float geometry = (FAULT ? 1.0f : std::abs(dot(point.ng, c->wi))) * c->weight;]])

fault(radiance-along-light-paths "paths from lights scatter as paths from the camera do"
      "StatisticalAgreement.BumpyRoom:StatisticalAgreement.BumpyGlass")
edit(integrators/light.cpp [[v.scatter.eval_cos(v.wo(), c->wi, TransportMode::kImportance, v.rng)]]
     [[v.scatter.eval_cos(v.wo(), c->wi, FAULT ? TransportMode::kRadiance : TransportMode::kImportance, v.rng)]])

fault(density-of-one-disk "rays of infinite lights have the density of the disk that was chosen" "${lights}")
edit(lights/emission_disks.cpp [[if (level == known || meets(s))]] [[if (level == known || (!(FAULT && known >= 0) && meets(s)))]])

fault(far-things-let-light-through "what lies before the start of a ray from infinitely far away does not block it"
      "${light}/under_a_far_roof")
edit(integrators/light_path.h [[depth == 1 && emitted->starts_within;]] [[!FAULT && depth == 1 && emitted->starts_within;]])

# ---- photons

set(sppm "LightTracing.Components*:VerifyScene.PathsFromLights*:Scenes/StatisticalSppm.*")
fault(photon-radius-not-squared "photons are spread over a disk whose area goes with its radius" "${sppm}")
edit(integrators/sppm.cpp [[static_cast<double>(kPi) * sqr(static_cast<double>(radius_));]]
     [[static_cast<double>(kPi) * (FAULT ? static_cast<double>(radius_) : sqr(static_cast<double>(radius_)));]])

fault(photons-per-photon-kept "photons are divided by the number that was kept" "${sppm}")
edit(integrators/sppm.cpp [[(disk * static_cast<double>(settings_.photons))]]
     [[(disk * static_cast<double>(FAULT ? grid_.photon_count() : settings_.photons))]])

fault(photons-without-cosine "photons are not divided by the cosine with which they arrive" "${sppm}")
edit(integrators/sppm.cpp [[1.0f / (cosine * std::min]] [[1.0f / ((FAULT ? 1.0f : cosine) * std::min]])

fault(photons-on-holes "photons are not weighed against the holes of the surface that they meet" "${sppm}")
edit(integrators/sppm.cpp [[std::min(scene_.alpha(v.hit, point, v.context), 1.0f)]]
     [[(FAULT ? 1.0f : std::min(scene_.alpha(v.hit, point, v.context), 1.0f))]])

fault(photons-of-mixtures-lost "photons are lost where a mixture shows a mirror" "${sppm}")
edit(integrators/sppm.cpp [[if (!mixed && !(]] [[if ((FAULT || !mixed) && !(]])

fault(photons-of-other-times "photons and camera see what moves at different times" "${sppm}")
edit(integrators/sppm.cpp [[settings_.from_camera, time_};]]
     [[settings_.from_camera, FAULT ? std::nullopt : std::optional<float>(time_)};]])

fault(near-mirrors-twice "light that a nearly smooth closure finds is not weighed against light sampling" "StatisticalSppmDirect.*")
edit(integrators/sppm.cpp [[if (scatter_pdf > 0.0f) {]] [[if (!FAULT && scatter_pdf > 0.0f) {]])

fault(direct-light-twice "photons bring direct light that is sampled already" "${sppm}")
edit(integrators/sppm.cpp [[(v.depth == 1 && !settings_.direct_photons)]] [[(!FAULT && v.depth == 1 && !settings_.direct_photons)]])

fault(photon-paths-too-long "events before and behind the photon are not counted together" "${sppm}")
edit(integrators/sppm.cpp [[depth + photon.events + 1 > settings_.max_depth]] [[(!FAULT && depth + photon.events + 1 > settings_.max_depth)]])

fault(radius-shrinks-too-fast "the law of the radius is that of its square" "Sppm.*")
edit(integrators/sppm.cpp [[std::exp(0.5 * log);]] [[std::exp((FAULT ? 1.0 : 0.5) * log);]])

fault(photons-of-one-side-missed "the search looks at the wrong cubes" "PhotonGrid.*")
edit(integrators/photon_grid.h [[cube(p, -0.5);]] [[cube(p, FAULT ? 0.0 : -0.5);]])

# ---- geometry

fault(normals-as-vectors "normals of instances are mapped like vectors" "Surface.*:Placement.*:Accel.*")
edit(shapes/placement.cpp [[const Vec3 ng = placement.to_object.transposed(s.ng);]]
     [[const Vec3 ng = FAULT ? m.vector(s.ng) : placement.to_object.transposed(s.ng);]])

fault(rays-start-on-the-surface "scattered rays start without distance to their surface" "Leak.*:Accel.*:QuadricLeak.*")
edit(accel/spawn.h [[return {offset_origin(s, w), w, kInfinity, before.time, before.medium};]]
     [[return {FAULT ? s.p : offset_origin(s, w), w, kInfinity, before.time, before.medium};]])

closed_forms(tests cap_light cylinder_light ring_light)
fault(quadric-stretch "sampling a stretched quadric leaves out how its area stretches" "Quadric*:${tests}:${lights}")
edit(shapes/quadric.cpp [[return 1.0f / (quadric.part.area() * quadric_area_stretch(quadric, q));]]
     [[return 1.0f / (quadric.part.area() * (FAULT ? 1.0f : quadric_area_stretch(quadric, q)));]])

fault(normal-maps-not-mirrored "the second axis of normal maps is n x u, wherever v grows" "Shapes/MirroredDetail.*")
edit(materials/surface_detail.cpp [[* handedness(point)]] [[* (FAULT ? 1.0f : handedness(point))]])

# ---- cameras

set(cameras "CameraBattery.*")
fault(importance-with-cos-cubed "the importance of a perspective camera lacks the lens's cosine" "${cameras}")
edit(cameras/perspective.cpp [[i.cosine = static_cast<float>(]] [[i.cosine = FAULT ? 1.0f : static_cast<float>(]])

fault(lens-without-area "the density on a lens is that on the unit lens" "${cameras}")
edit(cameras/lens.cpp [[/ static_cast<float>(area);]] [[/ static_cast<float>(FAULT ? 1.0 : area);]])

fault(points-behind-the-camera "a camera connects to points behind it" "${cameras}")
edit(cameras/perspective.cpp [[&& depth > 0.0)) return {};]] [[&& (FAULT || depth > 0.0))) return {};]])

fault(panorama-without-sine "the importance of a lat-long panorama takes all its rows to be as wide" "${cameras}")
edit(cameras/spherical.cpp [[kPi * std::hypot(local.x, local.z);]] [[kPi * (FAULT ? 1.0f : std::hypot(local.x, local.z));]])

# ---- guiding

fault(guide-not-weighted "light that is sampled is weighted as if no guide chose directions"
      "StatisticalGuiding.*")
edit(integrators/guiding/guided_scatter.h [[return cell_ ? mix(scatter_pdf]] [[return cell_ && !FAULT ? mix(scatter_pdf]])

fault(guide-on-an-octahedron "the density of a guide takes the octahedron for the sphere" "Guiding.*")
edit(integrators/guiding/direction_tree.cpp [[2 * level - 2) * (r * r * r);]]
     [[2 * level - 2) * (FAULT ? 1.0f : r * r * r);]])

# ---- motion

closed_forms(tests motion_edge motion_edge_camera)
fault(time-not-sampled "all rays leave when the shutter opens" "${tests}")
edit(integrators/camera_path.h [[if (scene.moves) at.time]] [[if (scene.moves && !FAULT) at.time]])

closed_forms(tests motion_disk_light motion_point_light motion_sphere_light)
fault(light-at-another-time "lights are sampled where they are when the shutter opens" "${tests}")
edit(integrators/next_event.h [[u_point, v.context, how.sampling());]]
     [[u_point, FAULT ? ShadingContext{} : v.context, how.sampling());]])

closed_forms(tests motion_growing_light motion_stretching_light)
fault(stretch-of-moving-lights "the density on a moving light leaves out how its size changes" "${tests}")
edit(lights/moving_light.cpp [[s->pdf *= solid_angle_stretch(at, s->wi);]]
     [[s->pdf *= FAULT ? 1.0f : solid_angle_stretch(at, s->wi);]])

# ---- samples that are no numbers

fault(invalid-samples-kept "NaN reaches the film" "InvalidSamples.*")
edit(film/invalid_samples.h [[const bool sound = is_sound(s);]] [[const bool sound = FAULT || is_sound(s);]])

# ---- images

fault(colours-not-decoded "sRGB colours are taken for linear ones" "Image.*:ImageMap.*")
edit(io/image.cpp [[return srgb_to_linear(encoded);]] [[return FAULT ? encoded : srgb_to_linear(encoded);]])

# ---- reading

fault(inexact-numbers "digits that no double holds are read as if they were exact" "Loading.*")
edit(io/decimal.h [[|| digits > uint64_t{1} << 53)]] [[|| (!FAULT && digits > uint64_t{1} << 53))]])

fault(byte-order-of-ply "big-endian PLY files in plain layouts are read as little-endian ones" "Loading.*:Ply.*")
edit(io/ply_rows.cpp [[if constexpr (kSwap) std::reverse]] [[if (kSwap && !FAULT) std::reverse]])
