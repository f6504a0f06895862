#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "embedding/normal_form.hh"
#include "embedding/refined_mesh.hh"
#include "embedding/straightening.hh"
#include "instances.hh"
#include "mesh/polygon_mesh.hh"

/// Embeddings of instances.hh on their way to refined meshes, as a job makes them.
namespace layout_embedding::test {

/// embedded_instances(1), made once in a process.
const std::vector<EmbeddedInstance>& all_embedded_instances();

/// A problem that is known to be one, embedded by insertion in random order. Throws where 50 orders
/// end in a dead end.
EmbeddedInstance embedded(const std::string& name, const PolygonMesh& layout,
                          const PolygonMesh& target, std::vector<Index> landmarks,
                          std::uint64_t seed);

/// A prism of 40 sides in the hourglass: its upright edges pass the neck, of `rings` times three
/// vertices, and wind around it together by about a seventh of a turn. Upside down they also have
/// to pass each other's landmarks.
EmbeddedInstance forty_strands_around_a_neck(int rings, bool upside_down);

/// The same instance on its target `scale` times as large.
EmbeddedInstance scaled(const EmbeddedInstance& instance, double scale);

NormalForm even_form(const EmbeddedInstance& instance);
NormalForm straight_form(const EmbeddedInstance& instance,
                         const StraighteningOptions& options = {});
/// Of a straight form.
NormalForm fair_form(const EmbeddedInstance& instance, NormalForm straight);

RefinedMesh cut(const EmbeddedInstance& instance, const NormalForm& form);

/// Cuts the target along `form` and sends the result through the checker.
void expect_valid(const EmbeddedInstance& instance, const NormalForm& form);

/// Gives the embedding every shape in turn, as a job does, and fails the test where the checker
/// refuses one, a triangle has no area, or straightening makes the paths longer.
void expect_valid_in_every_shape(const EmbeddedInstance& instance);

}  // namespace layout_embedding::test
