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

constexpr std::size_t max_halves = std::size_t{1} << 24;       // of a box that is converted as a whole
constexpr std::size_t halves_written = std::size_t{1} << 19;   // of a larger one at a time: they stay in the caches
constexpr std::size_t samples_written = std::size_t{1} << 22;  // at a time, between two checks for a stop
// How long the first process of a team that is stopped waits for the others to say what they have done: a stop takes
// less than a second, and what starts the processes may kill them soon after.
constexpr std::chrono::milliseconds patience{500};

// Lines that identify the work of writing a file.
std::vector<std::string> describe(const Attributes& attributes, const std::vector<NewDataset>& datasets) {
    std::vector<std::string> lines;
    const auto add = [&](const std::string& of, const Attributes& list) {
        for (const auto& [name, value] : list)
            lines.push_back(
                std::visit([&, &key = name](const auto& v) { return fmt::format("{}{} {}", of, key, v); }, value));
    };
    add("", attributes);
    for (const NewDataset& dataset : datasets) {
        lines.push_back(
            fmt::format("{} {} {} bytes each", dataset.name, fmt::join(dataset.shape, "x"), bytes_of(dataset.element)));
        add(dataset.name + " ", dataset.attributes);
    }
    return lines;
}

// The offsets of the datasets in a file that was laid out by an earlier run.
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

// What the first process of a team tells the others of a file: its temporary name, the offsets of its datasets, whether
// it can be resumed, and the parts that are done.
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
        lay_out_together(contents, resume);
}

void DatasetFile::lay_out_together(const Contents& contents, const std::optional<std::string>& resume) {
    static std::atomic<std::uint64_t> files{0};
    number_ = files++;
    communicator_->meet();  // each process has what it needs before disk space is taken
    if (communicator_->is_root()) {
        lay_out(contents, resume);
        SharedLayout layout{output_->temporary(), offsets_, journal_.has_value(), {}};
        if (journal_) layout.before = journal_->before();
        communicator_->share(to_text(layout));
        if (journal_) communicator_->listen(number_, [this](const std::string& lines) { take(lines); });
    } else {
        const SharedLayout layout = from_text(communicator_->share(""));
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

// A team's processes send what they have done to the first one, which has the journal.
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
        const auto end = std::chrono::steady_clock::now() + patience;
        while (closed_ + 1 < communicator_->size() && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
    } catch (const Error&) {
        // Ignored: parts that are not recorded will only be done again.
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

std::uint64_t DatasetFile::total(std::uint64_t here) {
    return communicator_ != nullptr ? communicator_->sum(here) : here;
}

void DatasetFile::put(std::size_t dataset, std::size_t sample, const void* from, std::size_t samples) {
    const std::uint64_t element = bytes_of(datasets_[dataset].element), at = element * sample;
    if (is_part_)
        write_to_records(*raw_, offsets_[dataset], at, from, element * samples);
    else
        raw_->write(offsets_[dataset] + at, from, element * samples);
}

// The system lets only one thread at a time write to a file. A lock per box makes threads wait once, instead of at each
// of the thousands of system calls for a box.
void DatasetFile::write_bytes(std::size_t dataset, const Box& box, const void* from) {
    const NewDataset& to = datasets_[dataset];
    const std::size_t bytes = bytes_of(to.element);
    const std::lock_guard lock(writing_);
    for_each_run(to.shape, box, [&](std::size_t there, std::size_t here, std::size_t n) {
        for (std::size_t done = 0, some = 0; done < n; done += some) {
            core::throw_if_stopped();
            some = std::min(samples_written, n - done);
            put(dataset, there + done, static_cast<const char*>(from) + bytes * (here + done), some);
        }
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
            core::throw_if_stopped();
            some = std::min(at_once, n - done);
            core::to_half(from + here + done, halves->data(), some);
            put(dataset, there + done, halves->data(), some);
        }
    });
}

void DatasetFile::write(std::size_t dataset, const Box& box, const std::complex<float>* from) {
    write_bytes(dataset, box, from);
}

void DatasetFile::finish() {
    raw_->close();
    if (communicator_ != nullptr) communicator_->meet();  // all have written
    if (output_ && is_part_) complete_part(output_->temporary(), path_);
    if (output_) output_->commit();
    if (journal_) journal_->remove();
    finished_ = true;
    if (communicator_ != nullptr) communicator_->meet();  // the file has its name
}

}  // namespace hogel::io::hdf5
