// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "hogel/core/half.h"
#include "hogel/error.h"
#include "hogel/io/finite.h"
#include "hogel/io/hdf5/dataset.h"

namespace hogel::io::hdf5 {
namespace {

using hdf5::Element;
using hdf5::Handle;

constexpr std::size_t halves_at_once = 32768;  // half floats that are converted together, few enough for the caches
constexpr std::size_t max_halves = std::size_t{1} << 24;      // of a box that is converted as a whole
constexpr std::size_t halves_written = std::size_t{1} << 19;  // of a larger one at a time: they stay in the caches
constexpr std::size_t max_chunk = std::size_t{256} << 20;

// Calls run(index in the array, index in the box, samples) for each contiguous run of samples of a box of a row-major
// array.
template <class Run>
void for_each_run(const std::vector<std::size_t>& shape, const Box& box, const Run& run) {
    // A run extends over the innermost axes that the box spans completely and along the next one.
    std::size_t axis = shape.size() - 1, length = box.extent[axis];
    while (axis > 0 && box.extent[axis] == shape[axis]) length *= box.extent[--axis];
    std::size_t runs = 1;
    for (std::size_t outer = 0; outer < axis; ++outer) runs *= box.extent[outer];
    for (std::size_t i = 0; i < runs; ++i) {
        std::size_t rest = i, at = 0, stride = 1;
        for (std::size_t a = shape.size(); a-- > 0;) {
            std::size_t index = box.start[a];
            if (a < axis) {
                index += rest % box.extent[a];
                rest /= box.extent[a];
            }
            at += index * stride;
            stride *= shape[a];
        }
        run(at, i * length, length);
    }
}

std::size_t samples_of(const std::vector<std::size_t>& shape) {
    std::size_t n = 1;
    for (std::size_t extent : shape) n *= extent;
    return n;
}

Handle open_dataset(hid_t file, const char* name, const std::filesystem::path& path) {
    const std::string whole = name;
    for (std::size_t slash = whole.find('/'); slash != std::string::npos; slash = whole.find('/', slash + 1))
        if (!hdf5::has_member(file, whole.substr(0, slash).c_str(), path))
            hdf5::fail(path, fmt::format("it has no group '{}'", whole.substr(0, slash)));
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

void DatasetReader::fail(const std::string& why) const {
    hdf5::fail(raw_->name(), fmt::format("its dataset '{}' {}", name_, why));
}

DatasetReader::DatasetReader(hid_t file, const char* name, std::vector<std::size_t> shape, bool complex,
                             std::shared_ptr<const core::RawFile> raw)
    : name_(name), shape_(std::move(shape)), raw_(std::move(raw)) {
    if (dataset_shape(file, name, raw_->name()) != shape_) fail("does not have the shape that its attributes tell");
    Handle dataset = open_dataset(file, name, raw_->name());
    const Handle type(H5Dget_type(dataset.id()), H5Tclose), properties(H5Dget_create_plist(dataset.id()), H5Pclose);
    if (!type.valid() || !properties.valid()) fail("is damaged: " + hdf5::reason());
    const bool fits = complex ? is_complex(type.id()) : H5Tget_class(type.id()) == H5T_FLOAT;
    if (!fits || H5Tget_size(type.id()) > 16)
        fail(complex ? "does not hold complex numbers {r, i}" : "does not hold floating point numbers");
    element_ = complex ? Element::complex_single : is_type(type.id(), Element::half) ? Element::half : Element::single;
    const std::size_t chunk_bytes = check_storage(dataset.id(), properties.id());
    const bool contiguous = H5Pget_layout(properties.id()) == H5D_CONTIGUOUS && is_type(type.id(), element_);
    if (contiguous)
        offset_ = H5Dget_offset(dataset.id());
    else
        by_hdf5_ = std::make_unique<SampleServer>(raw_->name(), name_, shape_.size(), element_, chunk_bytes);
    if (contiguous &&
        (offset_ > raw_->size() || samples_of(shape_) > (raw_->size() - offset_) / hdf5::bytes_of(element_)))
        fail("reaches beyond the end of the file");
}

// Refuses samples that were never written, which would be read as zeros, and references to other files. Returns the
// bytes of a chunk.
std::size_t DatasetReader::check_storage(hid_t dataset, hid_t properties) {
    const H5D_layout_t layout = H5Pget_layout(properties);
    if (H5Pget_external_count(properties) != 0 || layout == H5D_VIRTUAL) fail("keeps its samples in other files");
    const Handle type(H5Dget_type(dataset), H5Tclose);
    const std::size_t element_bytes = H5Tget_size(type.id());
    std::size_t chunk_bytes = element_bytes;
    if (layout == H5D_CHUNKED) {
        std::vector<hsize_t> chunk(shape_.size());
        if (H5Pget_chunk(properties, static_cast<int>(chunk.size()), chunk.data()) != static_cast<int>(chunk.size()))
            fail("is damaged: " + hdf5::reason());
        for (const hsize_t extent : chunk) {
            if (extent == 0 || extent > max_chunk / chunk_bytes)
                fail(fmt::format("has chunks of more than {} bytes", max_chunk));
            chunk_bytes *= extent;
        }
    }
    const hsize_t stored = H5Dget_storage_size(dataset);
    const bool filtered = layout == H5D_CHUNKED && H5Pget_nfilters(properties) > 0;
    if (stored == 0 || (!filtered && stored / element_bytes < samples_of(shape_))) fail("is not wholly written");
    return chunk_bytes;
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
        std::vector<std::uint16_t> halves(std::min(halves_at_once, samples_of(box.extent)));
        for_each_run(shape_, box, [&](std::size_t there, std::size_t here, std::size_t n) {
            for (std::size_t done = 0, some = 0; done < n; done += some) {
                some = std::min(halves.size(), n - done);
                raw_->read(offset_ + 2 * (there + done), halves.data(), 2 * some);
                finite = core::to_float(halves.data(), to + here + done, some) && finite;
            }
        });
    } else {
        for_each_run(shape_, box, [&](std::size_t there, std::size_t here, std::size_t n) {
            raw_->read(offset_ + sizeof(float) * there, to + here, sizeof(float) * n);
            finite = all_finite({to + here, n}) && finite;
        });
    }
    return finite;
}

void DatasetReader::read(const Box& box, std::complex<float>* to) const {
    if (by_hdf5_) return by_hdf5_->read(box, to);
    for_each_run(shape_, box, [&](std::size_t there, std::size_t here, std::size_t n) {
        raw_->read(offset_ + sizeof(*to) * there, to + here, sizeof(*to) * n);
    });
}

namespace {

// Lines that identify the work of writing a file, for the journal.
std::vector<std::string> describe(const hdf5::Attributes& attributes, const std::vector<hdf5::NewDataset>& datasets,
                                  const std::string& input) {
    std::vector<std::string> lines{input};
    const auto add = [&](const std::string& of, const hdf5::Attributes& list) {
        for (const auto& [name, value] : list)
            lines.push_back(
                std::visit([&, &key = name](const auto& v) { return fmt::format("{}{} {}", of, key, v); }, value));
    };
    add("", attributes);
    for (const hdf5::NewDataset& dataset : datasets) {
        lines.push_back(fmt::format("{} {} {} bytes each", dataset.name, fmt::join(dataset.shape, "x"),
                                    hdf5::bytes_of(dataset.element)));
        add(dataset.name + " ", dataset.attributes);
    }
    return lines;
}

// The offsets of the datasets in a file that was laid out by an earlier run.
std::vector<std::uint64_t> offsets_in(const std::filesystem::path& path,
                                      const std::vector<hdf5::NewDataset>& datasets) {
    const hdf5::Session session;
    const Handle file = hdf5::open_file(path);
    std::vector<std::uint64_t> offsets;
    for (const hdf5::NewDataset& dataset : datasets) {
        if (dataset_shape(file.id(), dataset.name.c_str(), path) != dataset.shape)
            hdf5::fail(path, fmt::format("its dataset '{}' has another shape than was begun", dataset.name));
        const Handle id(H5Dopen2(file.id(), dataset.name.c_str(), H5P_DEFAULT), H5Dclose);
        const haddr_t offset = H5Dget_offset(id.id());
        if (offset == HADDR_UNDEF) hdf5::fail(path, fmt::format("its dataset '{}' has no samples", dataset.name));
        offsets.push_back(offset);
    }
    return offsets;
}

}  // namespace

DatasetFile::DatasetFile(const std::filesystem::path& path, const hdf5::Attributes& attributes,
                         std::vector<hdf5::NewDataset> datasets, const std::optional<std::string>& resume)
    : output_(path, resume ? core::OutputFile::Unfinished::kept : core::OutputFile::Unfinished::removed),
      datasets_(std::move(datasets)) {
    const std::filesystem::path part = output_.temporary().lexically_normal();
    if (resume) {
        journal_.emplace(part.string() + ".journal", describe(attributes, datasets_, *resume), [&] { raw_->flush(); });
        if (journal_->begun() && std::filesystem::exists(part)) {
            offsets_ = offsets_in(part, datasets_);
            raw_.emplace(part, core::RawFile::Mode::write, path);
            return;
        }
    }
    offsets_ = hdf5::lay_out_file(part, path, attributes, datasets_);
    raw_.emplace(part, core::RawFile::Mode::write, path);
    raw_->reserve(raw_->size());  // HDF5 leaves the samples as a hole
    if (!journal_) return;
    raw_->flush();
    journal_->begin();
}

// The system lets only one thread at a time write to a file. A lock per box makes threads wait once, instead of at each
// of the thousands of system calls for a box.
void DatasetFile::write_bytes(std::size_t dataset, const Box& box, const void* from) {
    const hdf5::NewDataset& to = datasets_[dataset];
    const std::size_t bytes = hdf5::bytes_of(to.element);
    const std::lock_guard lock(writing_);
    for_each_run(to.shape, box, [&](std::size_t there, std::size_t here, std::size_t n) {
        raw_->write(offsets_[dataset] + bytes * there, static_cast<const char*>(from) + bytes * here, bytes * n);
    });
}

void DatasetFile::write(std::size_t dataset, const Box& box, const float* from) {
    if (datasets_[dataset].element != Element::half) return write_bytes(dataset, box, from);
    const std::size_t samples = samples_of(box.extent);
    auto halves = halves_.take();
    // Converted outside the lock, unless the halves would be a large part of the memory that the work takes.
    const std::size_t at_once = samples <= max_halves ? samples : halves_written;
    if (halves->size() < at_once) halves->resize(at_once);
    if (samples <= max_halves) {
        core::to_half(from, halves->data(), samples);
        return write_bytes(dataset, box, halves->data());
    }
    const std::lock_guard lock(writing_);
    for_each_run(datasets_[dataset].shape, box, [&](std::size_t there, std::size_t here, std::size_t n) {
        for (std::size_t done = 0, some = 0; done < n; done += some) {
            some = std::min(at_once, n - done);
            core::to_half(from + here + done, halves->data(), some);
            raw_->write(offsets_[dataset] + 2 * (there + done), halves->data(), 2 * some);
        }
    });
}

void DatasetFile::write(std::size_t dataset, const Box& box, const std::complex<float>* from) {
    write_bytes(dataset, box, from);
}

void DatasetFile::finish() {
    raw_->close();
    output_.commit();
    if (journal_) journal_->remove();
}

}  // namespace hogel::io::hdf5
