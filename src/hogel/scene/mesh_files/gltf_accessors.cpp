// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <type_traits>

#include <limits>

#include <algorithm>
#include <cstring>

#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/gltf.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr std::uint64_t max_size = ~std::uint32_t{0};

struct View {
    std::string_view data;
    std::size_t offset = 0;  ///< in its buffer
    std::size_t stride = 0;  ///< 0: contiguous elements
};

struct ElementType {
    std::string_view name;
    std::size_t columns, rows;
};
constexpr std::array element_types{ElementType{"SCALAR", 1, 1}, ElementType{"VEC2", 1, 2}, ElementType{"VEC3", 1, 3},
                                   ElementType{"VEC4", 1, 4},   ElementType{"MAT2", 2, 2}, ElementType{"MAT3", 3, 3},
                                   ElementType{"MAT4", 4, 4}};

}  // namespace

std::size_t component_size(unsigned type) {
    switch (type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            return 0;
    }
}

GltfAccessor read_accessor_type(const Gltf& gltf, const Json& object, const std::string& where) {
    GltfAccessor accessor;
    accessor.component_type = static_cast<unsigned>(gltf.number(object, where, "componentType", max_size));
    accessor.component_size = component_size(accessor.component_type);
    if (accessor.component_size == 0)
        gltf.reject(where + ".componentType", fmt::format("is {}", accessor.component_type),
                    "5120, 5121, 5122, 5123, 5125 or 5126");
    const auto type = object.find("type");
    const auto found = std::find_if(element_types.begin(), element_types.end(), [&](const ElementType& t) {
        return type != object.end() && *type == std::string(t.name);
    });
    if (found == element_types.end())
        gltf.reject(where + ".type", "is unknown", "SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
    accessor.type = found->name;
    std::size_t column = found->rows * accessor.component_size;
    if (found->columns > 1) column = (column + 3) / 4 * 4;  // matrix columns are aligned to 4 bytes
    accessor.element_size = found->columns * column;
    accessor.count = gltf.number(object, where, "count", max_size);
    if (accessor.count == 0) gltf.reject(where + ".count", "is 0", "at least 1");
    return accessor;
}

namespace {

std::uint64_t read_whole_number(const char* bytes, std::size_t size) {
    std::uint64_t value = 0;  // little-endian, like this machine
    std::memcpy(&value, bytes, size);
    return value;
}

/// Throws unless offsets in the view and in the buffer are multiples of the component size.
void check_alignment(const Gltf& gltf, const std::string& where, std::size_t offset, const View& view,
                     std::size_t size) {
    if (offset % size != 0 || (view.offset + offset) % size != 0)
        gltf.reject(where + ".byteOffset", fmt::format("is {}, in a view at {}", offset, view.offset),
                    fmt::format("multiples of {}, the size of its components", size));
}

class Accessors {
  public:
    Accessors(const Gltf& gltf, const GltfBuffers& buffers) : gltf_(gltf), buffer_bytes_(buffers.bytes()) {
        const Json& list = gltf.list("bufferViews");
        for (std::size_t i = 0; i < list.size(); ++i)
            views_.push_back(read_view(list, i, fmt::format("bufferViews[{}]", i), buffers));
    }

    GltfAccessor read(const Json& object, const std::string& where) {
        GltfAccessor accessor = read_accessor_type(gltf_, object, where);
        const std::uint64_t offset = gltf_.number(object, where, "byteOffset", max_size, 0);
        if (const auto number = gltf_.reference(object, where, "bufferView", "bufferViews")) {
            const View& view = views_[*number];
            check_alignment(gltf_, where, offset, view, accessor.component_size);
            accessor.stride = view.stride == 0 ? accessor.element_size : view.stride;
            if (accessor.stride < accessor.element_size)
                gltf_.reject(
                    where,
                    fmt::format("has elements of {} bytes every {} bytes", accessor.element_size, accessor.stride),
                    "a larger byteStride of its view");
            accessor.data = part(where, view, offset, accessor.count, accessor.stride, accessor.element_size);
        } else if (accessor.count > gltf_.file_size) {
            // Elements without data are zeros, of which a few bytes could request any number.
            gltf_.reject(where, fmt::format("has {} elements without data", accessor.count),
                         "no more than the file has bytes");
        }
        read_sparse(object, where, accessor);
        return accessor;
    }

  private:
    View read_view(const Json& list, std::size_t i, const std::string& where, const GltfBuffers& buffers) const {
        const Json& object = gltf_.object(list, i, where);
        const auto buffer = gltf_.reference(object, where, "buffer", "buffers");
        if (!buffer) gltf_.reject(where + ".buffer", "missing", "the number of a buffer");
        const std::string_view data = buffers[*buffer];
        View view;
        view.offset = gltf_.number(object, where, "byteOffset", max_size, 0);
        const std::uint64_t size = gltf_.number(object, where, "byteLength", max_size);
        if (size == 0 || view.offset > data.size() || size > data.size() - view.offset)
            gltf_.reject(where, fmt::format("is bytes {} to {} of a buffer", view.offset, view.offset + size),
                         fmt::format("a part of its {} bytes", data.size()));
        view.data = data.substr(view.offset, size);
        if (object.contains("byteStride")) {
            view.stride = gltf_.number(object, where, "byteStride", 252);
            if (view.stride < 4 || view.stride % 4 != 0)
                gltf_.reject(where + ".byteStride", fmt::format("is {}", view.stride), "a multiple of 4 from 4 to 252");
        }
        return view;
    }

    std::string_view part(const std::string& where, const View& view, std::size_t offset, std::uint64_t count,
                          std::size_t stride, std::size_t element) const {
        if (offset > view.data.size() || element > view.data.size() - offset ||
            count - 1 > (view.data.size() - offset - element) / stride)
            gltf_.reject(where,
                         fmt::format("has {} elements of {} bytes, every {} bytes from byte {} on", count, element,
                                     stride, offset),
                         fmt::format("elements in the {} bytes of its view", view.data.size()));
        return view.data.substr(offset);
    }

    const View& sparse_view(const Json& sparse, const std::string& where, const char* name) const {
        const auto found = sparse.find(name);
        if (found == sparse.end() || !found->is_object()) gltf_.reject(where + "." + name, "missing", "an object");
        const auto view = gltf_.reference(*found, where + "." + name, "bufferView", "bufferViews");
        if (!view) gltf_.reject(where + "." + name + ".bufferView", "missing", "the number of a view");
        return views_[*view];
    }

    void read_sparse(const Json& object, const std::string& where, GltfAccessor& accessor) {
        const auto sparse = object.find("sparse");
        if (sparse == object.end()) return;
        const std::string location = where + ".sparse";
        if (!sparse->is_object()) gltf_.reject(location, "is not an object", "one");
        const std::uint64_t count = gltf_.number(*sparse, location, "count", accessor.count);
        if (count == 0) gltf_.reject(location + ".count", "is 0", "at least 1");
        // Limit the copies of shared indices by thousands of accessors.
        sparse_count_ += count;
        if (sparse_count_ > max_shared * buffer_bytes_)
            gltf_.reject(location, fmt::format("and those before it replace {} elements", sparse_count_),
                         fmt::format("at most {} times the {} bytes of all buffers", max_shared, buffer_bytes_));
        const View& indices = sparse_view(*sparse, location, "indices");
        const View& values = sparse_view(*sparse, location, "values");
        const Json &index = (*sparse)["indices"], &value = (*sparse)["values"];
        const std::string index_location = location + ".indices", value_location = location + ".values";
        const auto type = static_cast<unsigned>(gltf_.number(index, index_location, "componentType", max_size));
        if (type != GltfAccessor::u8 && type != GltfAccessor::u16 && type != GltfAccessor::u32)
            gltf_.reject(index_location + ".componentType", fmt::format("is {}", type), "5121, 5123 or 5125");
        const std::size_t size = component_size(type);
        const std::uint64_t offset = gltf_.number(index, index_location, "byteOffset", max_size, 0);
        const std::uint64_t value_offset = gltf_.number(value, value_location, "byteOffset", max_size, 0);
        check_alignment(gltf_, index_location, offset, indices, size);
        check_alignment(gltf_, value_location, value_offset, values, accessor.component_size);
        const std::string_view numbers = part(index_location, indices, offset, count, size, size);
        accessor.replacements =
            part(value_location, values, value_offset, count, accessor.element_size, accessor.element_size);
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t number = read_whole_number(numbers.data() + i * size, size);
            if (number >= accessor.count || (i > 0 && number <= accessor.replaced.back()))
                gltf_.reject(index_location, fmt::format("has element {} at place {}", number, i),
                             fmt::format("increasing numbers less than {}", accessor.count));
            accessor.replaced.push_back(number);
        }
    }

    static constexpr std::uint64_t max_shared = 16;
    const Gltf& gltf_;
    std::uint64_t buffer_bytes_, sparse_count_ = 0;
    std::vector<View> views_;
};

template <class T>
float value_of(const char* from, bool normalized) {
    T value;
    std::memcpy(&value, from, sizeof value);
    if (std::is_floating_point_v<T> || !normalized) return static_cast<float>(value);
    return std::max(-1.0f, static_cast<float>(static_cast<double>(value) / std::numeric_limits<T>::max()));
}

float read_component(const char* from, unsigned type, bool normalized) {
    switch (type) {
        case 5120:
            return value_of<std::int8_t>(from, normalized);
        case GltfAccessor::u8:
            return value_of<std::uint8_t>(from, normalized);
        case 5122:
            return value_of<std::int16_t>(from, normalized);
        case GltfAccessor::u16:
            return value_of<std::uint16_t>(from, normalized);
        case GltfAccessor::u32:
            return value_of<std::uint32_t>(from, normalized);
        default:
            return value_of<float>(from, normalized);
    }
}

}  // namespace

std::vector<std::uint32_t> GltfAccessor::whole_numbers() const {
    std::vector<std::uint32_t> numbers(count);
    if (!data.empty())
        for (std::uint64_t i = 0; i < count; ++i)
            numbers[i] = static_cast<std::uint32_t>(read_whole_number(data.data() + i * stride, component_size));
    for (std::size_t i = 0; i < replaced.size(); ++i)
        numbers[replaced[i]] =
            static_cast<std::uint32_t>(read_whole_number(replacements.data() + i * element_size, component_size));
    return numbers;
}

std::vector<float> GltfAccessor::floats(bool normalized) const {
    const std::size_t components = element_size / component_size;
    std::vector<float> values(count * components);
    const auto read = [&](const char* from, float* to) {
        for (std::size_t c = 0; c < components; ++c)
            to[c] = read_component(from + c * component_size, component_type, normalized);
    };
    if (!data.empty())
        for (std::uint64_t i = 0; i < count; ++i) read(data.data() + i * stride, &values[i * components]);
    for (std::size_t i = 0; i < replaced.size(); ++i)
        read(replacements.data() + i * element_size, &values[replaced[i] * components]);
    return values;
}

std::vector<GltfAccessor> check_accessors(const Gltf& gltf, const GltfBuffers& buffers) {
    Accessors reader(gltf, buffers);
    const Json& list = gltf.list("accessors");
    std::vector<GltfAccessor> accessors;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string where = fmt::format("accessors[{}]", i);
        accessors.push_back(reader.read(gltf.object(list, i, where), where));
    }
    return accessors;
}

}  // namespace hogel::scene::mesh_files
