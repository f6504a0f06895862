#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hh"
#include "base/types.hh"

namespace layout_embedding {

/// An `.inp` file of the paper's reference implementation: an embedding problem.
struct ReferenceInput {
    /// The layout's file (`lf`) and the target's (`tif`), relative to this one.
    std::string layout_file;
    std::string target_file;
    /// Layout vertex and target vertex (`mv`), in the order of the file.
    std::vector<std::array<Index, 2>> matches;
};

/// A `.lem` file: an embedding as chains in a refined target.
struct ReferenceEmbedding {
    /// The `.inp` file (`inp`) and the refined target (`tf`), relative to this one.
    std::string input_file;
    std::string refined_file;
    struct Edge {
        std::array<Index, 2> layout_edge;
        std::vector<Index> chain;  // vertices of the refined target
    };
    /// Embedded edges (`ee`), in the order of the file: as a rule every one in both directions.
    std::vector<Edge> edges;
};

/// Read and write the two. `subject` begins the messages. Errors: fileEmpty (nothing of the
/// format), and with the line syntaxError, landmarkOutOfRange or indexOutOfRange (no 32-bit id).
Result<ReferenceInput> read_reference_input(std::string_view bytes, std::string_view subject);
Result<ReferenceEmbedding> read_reference_embedding(std::string_view bytes,
                                                    std::string_view subject);
std::string write_reference_input(const ReferenceInput& input);
/// Writes every edge in both directions, as the reference implementation does.
std::string write_reference_embedding(const ReferenceEmbedding& embedding);

/// The target vertex of each layout vertex. Errors: landmarkCount, where the matches are not one
/// for each of `vertex_count` layout vertices.
Result<std::vector<Index>> landmarks_of(const ReferenceInput& input, Index vertex_count,
                                        std::string_view subject);

}  // namespace layout_embedding
