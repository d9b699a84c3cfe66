// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "hogel/core/half.h"
#include "hogel/error.h"
#include "hogel/io/finite.h"
#include "hogel/io/hdf5/dataset.h"
#include "hogel/io/hdf5/runs.h"

namespace hogel::io::hdf5 {
namespace {

using hdf5::Element;
using hdf5::Handle;

constexpr std::size_t halves_per_block = 32768;   // half floats per conversion block, sized for the caches
constexpr std::size_t samples_per_block = 32768;  // complex numbers per read and check, likewise
constexpr std::size_t max_chunk = std::size_t{256} << 20;

Handle open_dataset(hid_t file, const char* name, const std::filesystem::path& path) {
    const std::string full_name = name;
    for (std::size_t slash = full_name.find('/'); slash != std::string::npos; slash = full_name.find('/', slash + 1))
        if (!hdf5::has_member(file, full_name.substr(0, slash).c_str(), path))
            hdf5::fail(path, fmt::format("it has no group '{}'", full_name.substr(0, slash)));
    if (!hdf5::has_member(file, name, path)) hdf5::fail(path, fmt::format("it has no dataset '{}'", name));
    Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
    if (!dataset.valid()) hdf5::fail(path, fmt::format("its dataset '{}' is damaged: {}", name, hdf5::reason()));
    return dataset;
}

bool is_complex(hid_t type) {
    if (H5Tget_class(type) != H5T_COMPOUND || H5Tget_nmembers(type) != 2) return false;
    for (const char* part : {"r", "i"}) {
        const int index = H5Tget_member_index(type, part);
        if (index < 0 || H5Tget_member_class(type, static_cast<unsigned>(index)) != H5T_FLOAT) return false;
    }
    return true;
}

bool is_type(hid_t type, Element element) { return H5Tequal(type, hdf5::type_of(element).id()) > 0; }

}  // namespace

std::vector<std::size_t> dataset_shape(hid_t file, const char* name, const std::filesystem::path& path) {
    const Handle dataset = open_dataset(file, name, path);
    const Handle space(H5Dget_space(dataset.id()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.id());
    if (rank < 0 || rank > H5S_MAX_RANK) hdf5::fail(path, fmt::format("its dataset '{}' is damaged", name));
    std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.id(), extents.data(), nullptr);
    return {extents.begin(), extents.end()};
}

Storage storage_of(hid_t dataset, const std::vector<std::size_t>& shape,
                   const std::function<void(const std::string&)>& fail) {
    const Handle type(H5Dget_type(dataset), H5Tclose), properties(H5Dget_create_plist(dataset), H5Pclose);
    if (!type.valid() || !properties.valid()) fail("is damaged: " + hdf5::reason());
    const H5D_layout_t layout = H5Pget_layout(properties.id());
    if (H5Pget_external_count(properties.id()) != 0 || layout == H5D_VIRTUAL) fail("keeps its samples in other files");
    const std::size_t element_bytes = H5Tget_size(type.id());
    Storage storage;
    storage.chunk_bytes = element_bytes;
    if (layout == H5D_CHUNKED) {
        const int axes = static_cast<int>(shape.size());
        std::vector<hsize_t> chunk(shape.size());
        if (H5Pget_chunk(properties.id(), axes, chunk.data()) != axes) fail("is damaged: " + hdf5::reason());
        for (const hsize_t extent : chunk) {
            if (extent == 0 || extent > max_chunk / storage.chunk_bytes)
                fail(fmt::format("has chunks of more than {} bytes", max_chunk));
            storage.chunk_bytes *= extent;
        }
        storage.chunk.assign(chunk.begin(), chunk.end());
    }
    const hsize_t stored = H5Dget_storage_size(dataset);
    const bool filtered = layout == H5D_CHUNKED && H5Pget_nfilters(properties.id()) > 0;
    if (stored == 0 || (!filtered && stored / element_bytes < samples_of(shape))) fail("is not wholly written");
    return storage;
}

void DatasetReader::fail(const std::string& why) const {
    hdf5::fail(raw_->name(), fmt::format("its dataset '{}' {}", name_, why));
}

DatasetReader::DatasetReader(hid_t file, const char* name, std::vector<std::size_t> shape, bool complex,
                             std::shared_ptr<const core::RawFile> raw)
    : name_(name), shape_(std::move(shape)), raw_(std::move(raw)) {
    if (dataset_shape(file, name, raw_->name()) != shape_) fail("does not have the shape given by its attributes");
    Handle dataset = open_dataset(file, name, raw_->name());
    const Handle type(H5Dget_type(dataset.id()), H5Tclose), properties(H5Dget_create_plist(dataset.id()), H5Pclose);
    if (!type.valid() || !properties.valid()) fail("is damaged: " + hdf5::reason());
    const bool fits = complex ? is_complex(type.id()) : H5Tget_class(type.id()) == H5T_FLOAT;
    if (!fits || H5Tget_size(type.id()) > 16)
        fail(complex ? "does not hold complex numbers {r, i}" : "does not hold floating point numbers");
    element_ = complex ? Element::complex_single : is_type(type.id(), Element::half) ? Element::half : Element::single;
    const Storage storage = storage_of(dataset.id(), shape_, [this](const std::string& why) { fail(why); });
    const bool contiguous = H5Pget_layout(properties.id()) == H5D_CONTIGUOUS && is_type(type.id(), element_);
    if (contiguous)
        offset_ = H5Dget_offset(dataset.id());
    else
        by_hdf5_ = std::make_unique<SampleServer>(raw_->name(), name_, shape_.size(), element_, storage.chunk_bytes);
    if (contiguous &&
        (offset_ > raw_->size() || samples_of(shape_) > (raw_->size() - offset_) / hdf5::bytes_of(element_)))
        fail("reaches beyond the end of the file");
}

bool DatasetReader::read(const Box& box, float* to) const {
    const bool half = element_ == Element::half;
    bool finite = true;
    if (by_hdf5_ && half) {
        std::vector<std::uint16_t> halves(samples_of(box.extent));
        by_hdf5_->read(box, halves.data());
        finite = core::to_float(halves.data(), to, halves.size());
    } else if (by_hdf5_) {
        by_hdf5_->read(box, to);
        finite = all_finite({to, samples_of(box.extent)});
    } else if (half) {
        std::vector<std::uint16_t> halves(std::min(halves_per_block, samples_of(box.extent)));
        for_each_run(shape_, box, [&](std::size_t source, std::size_t target, std::size_t n) {
            for (std::size_t done = 0, block = 0; done < n; done += block) {
                block = std::min(halves.size(), n - done);
                raw_->read(offset_ + 2 * (source + done), halves.data(), 2 * block);
                finite = core::to_float(halves.data(), to + target + done, block) && finite;
            }
        });
    } else {
        for_each_run(shape_, box, [&](std::size_t source, std::size_t target, std::size_t n) {
            raw_->read(offset_ + sizeof(float) * source, to + target, sizeof(float) * n);
            finite = all_finite({to + target, n}) && finite;
        });
    }
    return finite;
}

bool DatasetReader::read(const Box& box, std::complex<float>* to) const {
    float* const numbers = reinterpret_cast<float*>(to);  // two per sample
    if (by_hdf5_) {
        by_hdf5_->read(box, to);
        return all_finite({numbers, 2 * samples_of(box.extent)});
    }
    bool finite = true;
    for_each_run(shape_, box, [&](std::size_t source, std::size_t target, std::size_t n) {
        for (std::size_t done = 0, block = 0; done < n; done += block) {
            block = std::min(samples_per_block, n - done);
            raw_->read(offset_ + sizeof(*to) * (source + done), to + target + done, sizeof(*to) * block);
            finite = all_finite({numbers + 2 * (target + done), 2 * block}) && finite;
        }
    });
    return finite;
}

}  // namespace hogel::io::hdf5
