#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace layout_embedding {

/// Every error the library reports. The name that users see (command line, JavaScript
/// `LayoutError.code`), what it means and what to do stand in one table in error.cc; codes keep
/// their numbers for good, new ones are added at the end.
enum class ErrorCode : std::uint32_t {
    none = 0,
    // Reading files.
    fileEmpty,
    unknownFormat,
    syntaxError,
    indexOutOfRange,
    faceTooLarge,
    tooLarge,
    // Meshes and layouts as surfaces.
    noFaces,
    notTriangles,
    nonFinitePosition,
    coordinateTooLarge,
    degenerateFace,
    duplicateFace,
    coincidentVertices,
    unusedVertex,
    nonManifoldEdge,
    nonManifoldVertex,
    inconsistentOrientation,
    severalComponents,
    // Layouts.
    layoutLoop,
    // Layout, landmarks and target together.
    landmarkCount,
    landmarkOutOfRange,
    duplicateLandmark,
    landmarkOnBoundary,
    topologyMismatch,
    tooFewLandmarks,
    // Running.
    invalidOption,
    memoryLimit,
    unresolvedTie,
    realisationFailed,
    internal,
    // Template layouts.
    tooFewLandmarksForSurface,
    templateNotReached,
    // Patches.
    parametrisationFailed,
    // Landmarks as points.
    landmarkNeedsTarget,
    // Constraints on paths.
    invalidPath,
};

/// What a user can read about one error code.
struct ErrorInfo {
    ErrorCode code;
    /// The name in the interfaces, camelCase.
    std::string_view name;
    /// What the code means, one clause without a full stop.
    std::string_view meaning;
    /// What to do about it, one clause without a full stop, imperative.
    std::string_view advice;
};

/// The table row of `code`.
const ErrorInfo& error_info(ErrorCode code);

/// All table rows, in the order of the codes.
const std::vector<ErrorInfo>& all_error_infos();

/// An error as a value: the code, one sentence (what, where, what to do), and the places as
/// numbers.
struct Error {
    ErrorCode code = ErrorCode::none;
    std::string message;
    /// Named places, for example {"vertex", 12} or {"line", 3}; all indices 0-based, lines 1-based.
    std::vector<std::pair<std::string, std::int64_t>> details;
};

/// Builds an error whose message reads "<what_and_where>; <advice of the code>.".
Error make_error(ErrorCode code, std::string what_and_where,
                 std::vector<std::pair<std::string, std::int64_t>> details = {});

}  // namespace layout_embedding
