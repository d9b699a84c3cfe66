// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <sstream>
#include <thread>
#include <utility>

#include "hogel/core/half.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/io/hdf5/dataset.h"
#include "hogel/io/hdf5/runs.h"

namespace hogel::io::hdf5 {
namespace {

constexpr std::size_t max_halves = std::size_t{1} << 24;       // maximum size of a box that is converted in one piece
constexpr std::size_t halves_written = std::size_t{1} << 19;   // per block of a larger box, sized for the caches
constexpr std::size_t samples_written = std::size_t{1} << 22;  // per write between two stop checks
// Time that a stopped root waits for records of other ranks. The launcher may kill ranks soon after a stop.
constexpr std::chrono::milliseconds max_wait{500};

// Returns the lines that identify the work of writing a file.
std::vector<std::string> describe(const Attributes& attributes, const std::vector<NewDataset>& datasets) {
    std::vector<std::string> lines;
    const auto add = [&](const std::string& prefix, const Attributes& list) {
        for (const auto& [name, value] : list)
            lines.push_back(
                std::visit([&, &key = name](const auto& v) { return fmt::format("{}{} {}", prefix, key, v); }, value));
    };
    add("", attributes);
    for (const NewDataset& dataset : datasets) {
        lines.push_back(
            fmt::format("{} {} {} bytes each", dataset.name, fmt::join(dataset.shape, "x"), bytes_of(dataset.element)));
        add(dataset.name + " ", dataset.attributes);
    }
    return lines;
}

// Returns the offsets of the datasets in a file laid out by an earlier run.
std::vector<std::uint64_t> offsets_in(const std::filesystem::path& path, const std::vector<NewDataset>& datasets) {
    const Session session;
    const Handle file = open_file(path);
    std::vector<std::uint64_t> offsets;
    for (const NewDataset& dataset : datasets) {
        if (dataset_shape(file.id(), dataset.name.c_str(), path) != dataset.shape)
            fail(path, fmt::format("its dataset '{}' has another shape than was begun", dataset.name));
        const Handle id(H5Dopen2(file.id(), dataset.name.c_str(), H5P_DEFAULT), H5Dclose);
        const haddr_t offset = H5Dget_offset(id.id());
        if (offset == HADDR_UNDEF) fail(path, fmt::format("its dataset '{}' has no samples", dataset.name));
        offsets.push_back(offset);
    }
    return offsets;
}

// Layout as broadcast by the root. `before` holds the parts that an earlier run finished.
struct SharedLayout {
    std::filesystem::path temporary;
    std::vector<std::uint64_t> offsets;
    bool resumes = false;
    std::set<work::Journal::Part> before;
};

std::string to_text(const SharedLayout& layout) {
    std::string text = fmt::format("{} {}\n", layout.resumes ? 1 : 0, fmt::join(layout.offsets, " "));
    for (const work::Journal::Part& part : layout.before) text += fmt::format("{}\n", fmt::join(part, " "));
    return text + '\0' + layout.temporary.string();
}

std::vector<std::uint64_t> numbers_of(const std::string& line) {
    std::istringstream text(line);
    std::vector<std::uint64_t> numbers;
    for (std::uint64_t number = 0; text >> number;) numbers.push_back(number);
    return numbers;
}

SharedLayout from_text(const std::string& text) {
    const std::size_t end = text.find('\0');
    SharedLayout layout;
    layout.temporary = text.substr(end + 1);
    std::istringstream lines(text.substr(0, end));
    std::string line;
    std::getline(lines, line);
    layout.offsets = numbers_of(line);
    layout.resumes = layout.offsets.front() != 0;
    layout.offsets.erase(layout.offsets.begin());
    while (std::getline(lines, line)) layout.before.insert(numbers_of(line));
    return layout;
}

}  // namespace

DatasetFile::DatasetFile(const std::filesystem::path& path, Contents contents, const std::optional<std::string>& resume)
    : path_(path),
      communicator_(hogel::communicator()),
      datasets_(contents.datasets),
      is_part_(contents.part.has_value()) {
    if (contents.part)
        for (std::size_t i = 0; i < datasets_.size(); ++i)
            datasets_[i].shape.at(contents.part->bands[i].axis) = contents.part->bands[i].count;
    if (communicator_ == nullptr)
        lay_out(contents, resume);
    else
        lay_out_shared(contents, resume);
}

void DatasetFile::lay_out_shared(const Contents& contents, const std::optional<std::string>& resume) {
    static std::atomic<std::uint64_t> files{0};
    number_ = files++;
    communicator_->barrier();  // all memory is allocated before disk space
    if (communicator_->is_root()) {
        lay_out(contents, resume);
        SharedLayout layout{output_->temporary(), offsets_, journal_.has_value(), {}};
        if (journal_) layout.before = journal_->before();
        communicator_->broadcast(to_text(layout));
        if (journal_) communicator_->listen(number_, [this](const std::string& lines) { take(lines); });
    } else {
        const SharedLayout layout = from_text(communicator_->broadcast(""));
        offsets_ = layout.offsets;
        raw_.emplace(layout.temporary, core::RawFile::Mode::write, path_);
        if (layout.resumes)
            journal_.emplace(
                layout.before, [this] { raw_->flush(); },
                [this](const std::string& lines) { communicator_->send(number_, lines); });
    }
}

void DatasetFile::lay_out(const Contents& contents, const std::optional<std::string>& resume) {
    output_.emplace(path_, resume ? core::OutputFile::Unfinished::kept : core::OutputFile::Unfinished::removed);
    const std::filesystem::path part = output_->temporary().lexically_normal();
    if (resume) {
        std::vector<std::string> work = describe(contents.attributes, datasets_);
        work.insert(work.begin(), *resume);
        if (contents.part)
            work.insert(work.begin(), fmt::format("part {} of {}", contents.part->number, contents.part->count));
        journal_.emplace(part.string() + ".journal", work, [&] { raw_->flush(); });
        if (journal_->begun() && std::filesystem::exists(part)) {
            offsets_ = is_part_ ? PartReader(part).records() : offsets_in(part, datasets_);
            raw_.emplace(part, core::RawFile::Mode::write, path_);
            return;
        }
    }
    offsets_ = contents.part ? lay_out_part(part, path_, describe(contents.attributes, contents.datasets),
                                            contents.attributes, contents.datasets, *contents.part)
                             : lay_out_file(part, path_, contents.attributes, datasets_);
    raw_.emplace(part, core::RawFile::Mode::write, path_);
    raw_->reserve(raw_->size());  // HDF5 leaves the samples as a hole
    if (!journal_) return;
    raw_->flush();
    journal_->begin();
}

// The ranks send their records to the root, which keeps the journal.
DatasetFile::~DatasetFile() {
    if (communicator_ == nullptr || !journal_ || finished_) {
        if (communicator_ != nullptr && communicator_->is_root() && journal_) communicator_->listen(number_, {});
        return;
    }
    try {
        journal_->write();
        if (!communicator_->is_root()) {
            communicator_->send(number_, "");
            return;
        }
        const auto end = std::chrono::steady_clock::now() + max_wait;
        while (closed_ + 1 < communicator_->size() && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
    } catch (const Error&) {
        // Ignored: unrecorded parts are only repeated.
    }
    communicator_->listen(number_, {});
}

void DatasetFile::take(const std::string& lines) {
    try {
        if (lines.empty())
            ++closed_;
        else
            journal_->take(lines);
    } catch (const Error&) {
        // Ignored, as above; this process's own records fail too.
    }
}

std::unique_ptr<work::TileQueue> DatasetFile::share_tiles(std::size_t dataset, std::size_t tiles) {
    constexpr std::uint64_t max_datasets = std::uint64_t{1} << 16;
    if (communicator_ == nullptr) return nullptr;
    return std::make_unique<work::TileQueue>(*communicator_, number_ * max_datasets + dataset, tiles);
}

std::uint64_t DatasetFile::total(std::uint64_t local) {
    return communicator_ != nullptr ? communicator_->sum(local) : local;
}

void DatasetFile::put(std::size_t dataset, std::size_t sample, const void* from, std::size_t samples) {
    const std::uint64_t element = bytes_of(datasets_[dataset].element), offset = element * sample;
    if (is_part_)
        write_to_records(*raw_, offsets_[dataset], offset, from, element * samples);
    else
        raw_->write(offsets_[dataset] + offset, from, element * samples);
}

// The system serialises writes to a file. Wait once per box, not at each of thousands of system calls.
void DatasetFile::write_bytes(std::size_t dataset, const Box& box, const void* from) {
    const NewDataset& to = datasets_[dataset];
    const std::size_t bytes = bytes_of(to.element);
    const std::lock_guard lock(writing_);
    for_each_run(to.shape, box, [&](std::size_t destination, std::size_t source, std::size_t n) {
        for (std::size_t done = 0, block = 0; done < n; done += block) {
            core::throw_if_stopped();
            block = std::min(samples_written, n - done);
            put(dataset, destination + done, static_cast<const char*>(from) + bytes * (source + done), block);
        }
    });
}

void DatasetFile::write(std::size_t dataset, const Box& box, const float* from) {
    if (datasets_[dataset].element != Element::half) return write_bytes(dataset, box, from);
    const std::size_t samples = samples_of(box.extent);
    auto halves = halves_.take();
    // Convert outside the lock, unless the halves would need a large part of the memory.
    const std::size_t block_samples = samples <= max_halves ? samples : halves_written;
    if (halves->size() < block_samples) halves->resize(block_samples);
    if (samples <= max_halves) {
        core::to_half(from, halves->data(), samples);
        return write_bytes(dataset, box, halves->data());
    }
    const std::lock_guard lock(writing_);
    for_each_run(datasets_[dataset].shape, box, [&](std::size_t destination, std::size_t source, std::size_t n) {
        for (std::size_t done = 0, block = 0; done < n; done += block) {
            core::throw_if_stopped();
            block = std::min(block_samples, n - done);
            core::to_half(from + source + done, halves->data(), block);
            put(dataset, destination + done, halves->data(), block);
        }
    });
}

void DatasetFile::write(std::size_t dataset, const Box& box, const std::complex<float>* from) {
    write_bytes(dataset, box, from);
}

void DatasetFile::finish() {
    raw_->close();
    if (communicator_ != nullptr) communicator_->barrier();  // all ranks have written
    if (output_ && is_part_) complete_part(output_->temporary(), path_);
    if (output_) output_->commit();
    if (journal_) journal_->remove();
    finished_ = true;
    if (communicator_ != nullptr) communicator_->barrier();  // the file has its final name
}

}  // namespace hogel::io::hdf5
