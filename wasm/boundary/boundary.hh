#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/embed_job.hh"
#include "apps/quad_mesh.hh"
#include "apps/surface_map.hh"
#include "base/error.hh"
#include "embedding/checker.hh"
#include "embedding/refined_mesh.hh"
#include "layout/layout.hh"
#include "mesh/mesh_attributes.hh"
#include "mesh/polygon_mesh.hh"
#include "mesh/triangle_mesh.hh"
#include "surface/polylines.hh"

/// The C boundary of the library in WebAssembly, called by src/core.ts alone.
///
/// - Objects are handles: numbers from 1 on, never used twice, each made by a function that says so
///   and freed by boundary_destroy(). 0 is no object.
/// - Functions that can fail return 0 (or kFailed where 0 means something); the error then stands
///   in the error functions below until the next failure. No exception leaves a function.
/// - Data come in through memory from boundary_allocate(), and go out through views: the last
///   viewed array lies at boundary_view_data() and is valid until the next call of any function.
/// - Text is UTF-8. 64-bit integers are i64, BigInt in JavaScript.
#define BOUNDARY_EXPORT(name) extern "C" __attribute__((export_name(#name), used))

namespace layout_embedding::boundary {

/// What functions return that otherwise return a number from 0 on.
inline constexpr std::int32_t kFailed = -1;

/// A handle whose object has another type or is gone.
struct InvalidHandle : std::logic_error {
    using std::logic_error::logic_error;
};

/// A polygon mesh as it was read, with what repairing it did.
struct MeshObject {
    PolygonMesh mesh;
    std::vector<std::string> notes;
    /// Per vertex of the input: its id here, kNone where removed; empty without a repair.
    std::vector<Index> vertex_map;
    /// Null where they were not asked for.
    std::shared_ptr<const MeshAttributes> attributes;
};

struct LayoutObject {
    std::shared_ptr<const Layout> layout;
};

struct TargetObject {
    std::shared_ptr<const TriangleMesh> target;
    /// To be carried over to refined meshes; null for none.
    std::shared_ptr<const MeshAttributes> attributes;
};

struct LandmarksObject {
    std::vector<Index> landmarks;
    /// Per landmark, "" for none; empty in formats without names.
    std::vector<std::string> names;
    std::vector<std::string> notes;
};

struct JobObject {
    EmbedJob job;
    /// Of the target; null for none.
    std::shared_ptr<const MeshAttributes> attributes;
};

/// An embedding that is kept whatever becomes of its job.
struct EmbeddingObject {
    std::shared_ptr<const Layout> layout;
    MappedTarget target;
};

/// A quad mesh that is being made, and what it is made of.
struct QuadJobObject {
    std::shared_ptr<const Layout> layout;
    std::shared_ptr<const TriangleMesh> target;
    RefinedMesh refined;
    QuadMeshJob job;

    QuadJobObject(const EmbedJob& embedding, const QuadOptions& options)
        : layout(embedding.problem().layout),
          target(embedding.problem().target),
          refined(*embedding.result().refined),
          job(*layout, *target, refined, options)
    {}
};

/// A claimed embedding on its way to the checker, and the verdict.
struct CheckObject {
    RefinedMesh refined;
    std::vector<std::array<Index, 2>> layout_edges;
    std::vector<std::vector<WeakPoint>> weak_paths;
    CheckReport report;
};

/// All living objects of one type by handle.
template <typename T>
class HandleTable {
public:
    std::uint32_t add(std::unique_ptr<T> object);
    T& get(std::uint32_t handle);
    bool destroy(std::uint32_t handle) { return objects_.erase(handle) > 0; }

private:
    std::map<std::uint32_t, std::unique_ptr<T>> objects_;
};

/// The handle of the next object, whatever its type.
std::uint32_t next_handle();

template <typename T>
HandleTable<T>& handles()
{
    static HandleTable<T> table;
    return table;
}

template <typename T>
std::uint32_t HandleTable<T>::add(std::unique_ptr<T> object)
{
    const std::uint32_t handle = next_handle();
    objects_.emplace(handle, std::move(object));
    return handle;
}

template <typename T>
T& HandleTable<T>::get(std::uint32_t handle)
{
    const auto found = objects_.find(handle);
    if (found == objects_.end()) {
        throw InvalidHandle("handle " + std::to_string(handle) + " is not an object of this kind");
    }
    return *found->second;
}

/// The paths to draw that were made last: see paths.cc.
Polylines& drawn_paths();

/// Lists from one after the other; offsets have one more entry than there are lists.
template <typename T>
std::vector<std::vector<T>> unflattened(const T* flat, const Index* offsets, std::size_t count)
{
    std::vector<std::vector<T>> lists(count);
    for (std::size_t i = 0; i < count; ++i) {
        lists[i].assign(flat + offsets[i], flat + offsets[i + 1]);
    }
    return lists;
}

/// Steps a job of any kind for so many milliseconds at least: 1 while there is more to do.
template <typename Job>
std::int32_t step_for(Job& job, double milliseconds)
{
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    bool more = true;
    do {
        more = job.step();
    } while (more && std::chrono::duration<double, std::milli>(Clock::now() - start).count() <
                         milliseconds);
    return static_cast<std::int32_t>(more);
}

/// Makes `error` the last one.
void set_error(Error error);

/// Shows `count` elements at `data`, which must stay where they are until the next call.
void set_view(const void* data, std::size_t count);
template <typename T>
void set_view(const std::vector<T>& values)
{
    set_view(values.data(), values.size());
}
void set_view(std::string_view text);

/// Keeps `values` for the caller to look at.
template <typename T>
void set_owned_view(const std::vector<T>& values);
void set_owned_view(std::string text);
std::vector<std::byte>& view_storage();

template <typename T>
void set_owned_view(const std::vector<T>& values)
{
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<std::byte>& storage = view_storage();
    storage.resize(values.size() * sizeof(T));
    if (!values.empty()) {
        std::memcpy(storage.data(), values.data(), storage.size());
    }
    set_view(storage.data(), values.size());
}

/// Runs `body` and turns whatever it throws into the last error and `failed`.
template <typename Body, typename Value>
Value guarded(Value failed, Body&& body)
{
    try {
        return body();
    } catch (const std::bad_alloc&) {
        set_error(
            make_error(ErrorCode::memoryLimit, "the memory of the WebAssembly module is full"));
    } catch (const std::length_error&) {
        set_error(make_error(ErrorCode::memoryLimit,
                             "an array larger than WebAssembly can address was needed"));
    } catch (const std::exception& exception) {
        set_error(make_error(ErrorCode::internal, exception.what()));
    } catch (...) {
        set_error(make_error(ErrorCode::internal, "an unknown exception was thrown"));
    }
    return failed;
}

/// The bytes of an argument.
inline std::string_view text_argument(const char* data, std::size_t size)
{
    return {data, size};
}

}  // namespace layout_embedding::boundary
