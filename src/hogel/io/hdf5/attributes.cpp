// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "hogel/error.h"
#include "hogel/io/hdf5/hdf5.h"

namespace hogel::io::hdf5 {
namespace {

constexpr std::size_t max_text = 60000;  // an object header message of HDF5 holds 64 kB
constexpr hsize_t max_attributes = 1000;

struct Attribute {
    Handle id, type;
};

// Opens an attribute with a single value: a scalar or an array of one element.
Attribute open_attribute(hid_t object, const char* name, const std::filesystem::path& path) {
    if (!has_attribute(object, name, path)) fail(path, fmt::format("its attribute '{}' is missing", name));
    Attribute attribute;
    attribute.id = Handle(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
    attribute.type = Handle(H5Aget_type(attribute.id.id()), H5Tclose);
    const Handle space(H5Aget_space(attribute.id.id()), H5Sclose);
    if (!attribute.id.valid() || !attribute.type.valid() || !space.valid())
        fail(path, fmt::format("its attribute '{}' is damaged: {}", name, reason()));
    if (H5Sget_simple_extent_npoints(space.id()) != 1)
        fail(path, fmt::format("its attribute '{}' is not a single value", name));
    return attribute;
}

bool is_text(const Attribute& attribute) { return H5Tget_class(attribute.type.id()) == H5T_STRING; }

std::string text_of(const Attribute& attribute, const char* name, const std::filesystem::path& path) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_cset(type.id(), H5Tget_cset(attribute.type.id()));
    const auto check = [&](herr_t status) {
        if (status < 0) fail(path, fmt::format("its attribute '{}' cannot be read: {}", name, reason()));
    };
    if (H5Tis_variable_str(attribute.type.id()) > 0) {
        H5Tset_size(type.id(), H5T_VARIABLE);
        char* characters = nullptr;
        check(H5Aread(attribute.id.id(), type.id(), &characters));
        std::string text = characters != nullptr ? characters : "";
        H5free_memory(characters);
        return text;
    }
    const std::size_t size = H5Tget_size(attribute.type.id());
    if (size > max_text) fail(path, fmt::format("its attribute '{}' is a text of {} bytes", name, size));
    std::string text(size, '\0');
    check(H5Aread(attribute.id.id(), attribute.type.id(), text.data()));
    text.resize(std::min(text.find('\0'), text.size()));
    return text;
}

}  // namespace

bool has_attribute(hid_t object, const char* name, const std::filesystem::path& path) {
    const htri_t exists = H5Aexists(object, name);
    if (exists < 0) fail(path, "it is damaged: " + reason());
    return exists > 0;
}

bool has_member(hid_t group, const char* name, const std::filesystem::path& path) {
    const htri_t exists = H5Lexists(group, name, H5P_DEFAULT);
    if (exists < 0) fail(path, "it is damaged: " + reason());
    H5L_info_t link;
    return exists > 0 && H5Lget_info(group, name, &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD;
}

double read_number(hid_t object, const char* name, const std::filesystem::path& path) {
    const Attribute attribute = open_attribute(object, name, path);
    const H5T_class_t kind = H5Tget_class(attribute.type.id());
    double value = 0;
    if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || H5Aread(attribute.id.id(), H5T_NATIVE_DOUBLE, &value) < 0)
        fail(path, fmt::format("its attribute '{}' is not a number", name));
    return value;
}

std::uint64_t read_count(hid_t object, const char* name, const std::filesystem::path& path) {
    const Attribute attribute = open_attribute(object, name, path);
    std::uint64_t value = 0;
    if (H5Tget_class(attribute.type.id()) != H5T_INTEGER || H5Aread(attribute.id.id(), H5T_NATIVE_UINT64, &value) < 0)
        fail(path, fmt::format("its attribute '{}' is not a whole number", name));
    return value;
}

std::string read_text(hid_t object, const char* name, const std::filesystem::path& path) {
    const Attribute attribute = open_attribute(object, name, path);
    if (!is_text(attribute)) fail(path, fmt::format("its attribute '{}' is not a text", name));
    return text_of(attribute, name, path);
}

void check_format(hid_t file, const char* format, const char* dataset, const std::filesystem::path& path) {
    if (!has_attribute(file, "format", path))
        fail(path, fmt::format("it is an HDF5 file, but not a {0}: an attribute \"format\" = \"{0}\" and a dataset "
                               "\"{1}\" were expected",
                               format, dataset));
    const std::string found = read_text(file, "format", path);
    if (found != format) fail(path, fmt::format("it is a '{}', but a '{}' was expected", found, format));
    const std::uint64_t version = read_count(file, "format_version", path);
    if (version != format_version)
        fail(path, fmt::format("its format_version is {}, but this program reads version {}", version, format_version));
}

Attributes root_attributes(const char* format, const Metadata& metadata) {
    Attributes attributes{{"format", format}, {"format_version", format_version}};
    for (const auto& [key, text] : metadata) {
        const auto same_key = [&](const auto& attribute) { return attribute.first == key; };
        if (key.empty() || key.find('\0') != std::string::npos || std::ranges::any_of(attributes, same_key))
            throw Error(ErrorCode::usage, fmt::format("metadata '{}': the key is empty, reserved or there twice", key));
        if (key.size() > 255 || text.size() >= max_text || attributes.size() >= max_attributes)
            throw Error(ErrorCode::usage, fmt::format("metadata '{}' is more than a file holds: {} entries of {} bytes",
                                                      key, max_attributes, max_text));
        attributes.emplace_back(key, text);
    }
    return attributes;
}

Metadata read_metadata(hid_t file, const std::filesystem::path& path) {
    Metadata metadata;
    H5O_info_t info;
    if (H5Oget_info2(file, &info, H5O_INFO_NUM_ATTRS) < 0) fail(path, reason());
    for (hsize_t i = 0; i < std::min(info.num_attrs, max_attributes); ++i) {
        const Handle id(H5Aopen_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        std::string name(256, '\0');
        const ssize_t length = id.valid() ? H5Aget_name(id.id(), name.size(), name.data()) : -1;
        if (length < 0) fail(path, fmt::format("its attributes are damaged: {}", reason()));
        name.resize(std::min(static_cast<std::size_t>(length), name.size() - 1));
        if (name == "format" || name == "format_version") continue;
        const Handle type(H5Aget_type(id.id()), H5Tclose);
        if (H5Tget_class(type.id()) == H5T_STRING) metadata.emplace_back(name, read_text(file, name.c_str(), path));
    }
    return metadata;
}

}  // namespace hogel::io::hdf5
