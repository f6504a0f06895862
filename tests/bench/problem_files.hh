#pragma once

#include <string>

#include "base/result.hh"
#include "layout/embedding_problem.hh"

namespace layout_embedding {

/// Reads and validates the problem of a native program: files of layout, target and landmarks, the
/// last one or `proximity`.
Result<EmbeddingProblem> load_problem(const std::string& layout_file,
                                      const std::string& target_file, const std::string& landmarks);

/// CPU seconds of this process so far.
double cpu_seconds();

}  // namespace layout_embedding
