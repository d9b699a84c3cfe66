// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "view/viewable.h"
#include "view/waves.h"

namespace hogel::view {

/// A hologram that is looked at, of one or three wavelengths: a file or a field of another program.
class HologramViewable final : public Viewable {
  public:
    /// Reads the fields if their samples fit into half of `memory`. Throws Error(bad_input) for other numbers of
    /// wavelengths.
    HologramViewable(Fields fields, std::size_t memory, const Progress& progress);

    double width() const override;
    double height() const override;
    bool has_rays() const override { return false; }
    std::size_t looks() const override { return waves_->looks(); }
    nlohmann::ordered_json facts() const override;
    double exposure() const override { return exposure_; }
    Reading read(const View& view, const PickPoint& point) const override;
    /// The clearest plane in focus of the samples around the spot. Throws Error(usage) if none stands out there.
    double focus(const View& view, const PickPoint& point, const Progress& progress) override;
    /// intensity, phase, real: the samples of a colour around the spot, one a pixel. spectrum: the light of those
    /// samples by frequency, four decades of it, frequency zero in the middle, x to the right and y upwards.
    Photograph inside(const View& view, const PickPoint& point, const Inside& inside,
                      const Progress& progress) override;
    FocusSearch find_focus(const Progress& progress) override;
    /// Counts those of the first wavelength, in up to 1024 × 1024 samples in the middle.
    LevelCounts count_levels(const std::string& encoding, const Progress& progress) override;

  protected:
    Image by_rays(const View& view, const Progress& progress) override;
    void by_waves(const View& view, std::size_t looks, const OnLooks& shown, const Progress& progress) override;

  private:
    Field around(const Reading& point, std::size_t colour, std::size_t side) const;
    FocusOptions depths(std::size_t planes) const;
    void measure(const Progress& progress);

    Fields fields_;
    std::unique_ptr<Waves> waves_;
    double exposure_ = 1;
    double efficiency_ = 0;  // mean |F|² / max |F|²
};

}  // namespace hogel::view
