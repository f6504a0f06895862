// Memory, errors, views and the version: what every other function of the boundary rests on.
#include <cstdlib>

#include "apps/landmark_drag.hh"
#include "apps/quad_mesh.hh"
#include "boundary/boundary.hh"
#include "formats/reference_files.hh"

namespace layout_embedding::boundary {

namespace {

Error last_error;
const void* view_data = nullptr;
std::size_t view_count = 0;

}  // namespace

std::uint32_t next_handle()
{
    static std::uint32_t last = 0;
    return ++last;
}

void set_error(Error error)
{
    last_error = std::move(error);
}

void set_view(const void* data, std::size_t count)
{
    view_data = data;
    view_count = count;
}

void set_view(std::string_view text)
{
    set_view(text.data(), text.size());
}

std::vector<std::byte>& view_storage()
{
    static std::vector<std::byte> storage;
    return storage;
}

void set_owned_view(std::string text)
{
    static std::string storage;
    storage = std::move(text);
    set_view(storage);
}

namespace {

/// The text of an error table column by code; an empty view beyond the table.
template <typename Column>
std::uint32_t view_error_info(std::uint32_t code, Column column)
{
    if (code >= all_error_infos().size()) {
        return 0;
    }
    set_view(all_error_infos()[code].*column);
    return 1;
}

}  // namespace

/// Memory for an argument, null where there is none left; freed by boundary_release().
BOUNDARY_EXPORT(boundary_allocate) void* boundary_allocate(std::size_t bytes)
{
    return std::malloc(bytes > 0 ? bytes : 1);
}

BOUNDARY_EXPORT(boundary_release) void boundary_release(void* memory)
{
    std::free(memory);
}

BOUNDARY_EXPORT(boundary_view_data) const void* boundary_view_data()
{
    return view_data;
}
/// Number of elements (not bytes) of the view.
BOUNDARY_EXPORT(boundary_view_count) std::size_t boundary_view_count()
{
    return view_count;
}

/// Frees an object of any type; an unknown handle is ignored.
BOUNDARY_EXPORT(boundary_destroy) void boundary_destroy(std::uint32_t handle)
{
    handles<MeshObject>().destroy(handle) || handles<LayoutObject>().destroy(handle) ||
        handles<TargetObject>().destroy(handle) || handles<LandmarksObject>().destroy(handle) ||
        handles<JobObject>().destroy(handle) || handles<CheckObject>().destroy(handle) ||
        handles<ReferenceInput>().destroy(handle) || handles<QuadMesh>().destroy(handle) ||
        handles<LandmarkDrag>().destroy(handle) || handles<EmbeddingObject>().destroy(handle) ||
        handles<SurfaceMap>().destroy(handle) || handles<SurfaceMapJob>().destroy(handle) ||
        handles<QuadJobObject>().destroy(handle);
}

/// Views the name of the last error's code.
BOUNDARY_EXPORT(boundary_error_code) void boundary_error_code()
{
    set_view(error_info(last_error.code).name);
}

BOUNDARY_EXPORT(boundary_error_message) void boundary_error_message()
{
    set_view(std::string_view(last_error.message));
}

BOUNDARY_EXPORT(boundary_error_detail_count) std::size_t boundary_error_detail_count()
{
    return last_error.details.size();
}

/// Views the name of a detail and returns its number.
BOUNDARY_EXPORT(boundary_error_detail) double boundary_error_detail(std::size_t place)
{
    const auto& [name, value] = last_error.details[place];
    set_view(std::string_view(name));
    return static_cast<double>(value);
}

/// The error table, row by row: each function views one column and returns 0 beyond the last row.
BOUNDARY_EXPORT(boundary_error_info_name) std::uint32_t boundary_error_info_name(std::uint32_t code)
{
    return view_error_info(code, &ErrorInfo::name);
}

BOUNDARY_EXPORT(boundary_error_info_meaning)
std::uint32_t boundary_error_info_meaning(std::uint32_t code)
{
    return view_error_info(code, &ErrorInfo::meaning);
}

BOUNDARY_EXPORT(boundary_error_info_advice)
std::uint32_t boundary_error_info_advice(std::uint32_t code)
{
    return view_error_info(code, &ErrorInfo::advice);
}

/// Views the library's version.
BOUNDARY_EXPORT(boundary_version) void boundary_version()
{
    set_view(std::string_view(LAYOUT_EMBEDDING_VERSION));
}

}  // namespace layout_embedding::boundary
