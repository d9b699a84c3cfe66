// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>

#include "view/viewable.h"
#include "view/waves.h"

namespace hogel::view {

/// A light field that is looked at: its samples in memory, in the order that eyes want them.
class LightFieldViewable final : public Viewable {
  public:
    /// Reads `shown`, which is `light_field` or some hogels of it; readings come from `light_field` itself.
    /// @param waves  those of its holograms; none of a first look
    LightFieldViewable(LightField light_field, LightField shown, std::size_t memory, const Progress& progress,
                       std::unique_ptr<Waves> waves = {});

    /// The same light field with other waves.
    LightFieldViewable(const LightFieldViewable& other, std::unique_ptr<Waves> waves);

    const LightField& light_field() const { return light_field_; }
    const LightFieldGrid& grid() const { return light_field_.grid(); }
    const LightFieldGrid& shown() const { return rays_->shown; }

    /// Shows it with another exposure than its automatic one.
    void set_exposure(double exposure) { exposure_ = exposure; }
    /// What it would be without errors, which can be seen beside it from now on. Its samples are read when a picture
    /// needs them. Before it is shown.
    void set_original(LightField original);
    /// The bytes that each hogel takes in its file, [t][s]; no elements: they are not known.
    void set_bytes_of_hogels(Array<double, 2> bytes);

    double width() const override { return grid().width(); }
    double height() const override { return grid().height(); }
    bool has_rays() const override { return true; }
    bool has_original() const override { return original_ != nullptr; }
    std::size_t looks() const override { return waves_ ? waves_->looks() : 0; }
    nlohmann::ordered_json facts() const override;
    double exposure() const override { return exposure_; }
    Reading read(const View& view, const PickPoint& point) const override;
    /// As the light field knows it, otherwise where a few pixels around the spot are sharpest.
    double focus(const View& view, const PickPoint& point, const Progress& progress) override;
    /// hogel: the directions of one hogel. views: the light field from directions across and down. s-u, t-v: the
    /// epipolar planes through the spot, which run along a row or a column of hogels. depth: near is bright. coverage:
    /// the share of each hogel's rays that meet something, or without depth that are not black. rate: the bytes that
    /// each hogel takes, between the fewest and the most.
    Photograph inside(const View& view, const PickPoint& point, const Inside& inside,
                      const Progress& progress) override;

  protected:
    Image by_rays(const View& view, const Progress& progress) override;
    void by_waves(const View& view, std::size_t looks, const OnLooks& shown, const Progress& progress) override;

  private:
    // The samples of a light field in memory, which subjects that differ in waves share.
    struct Rays {
        Rays(LightField light_field, std::size_t memory, const Progress& progress)
            : shown(light_field.grid()), photographer(std::move(light_field), {.memory = memory}, progress) {}
        LightFieldGrid shown;
        std::mutex photographing;  // rays are photographed beside waves too
        RayPhotographer photographer;
    };
    // What is read when it is first needed.
    struct Original {
        LightField light_field;
        std::size_t memory;
        std::unique_ptr<Rays> rays;
    };

    Image photograph_rays(Rays& rays, const View& view, const Progress& progress);
    double sharpest(const View& view, const PickPoint& point, const Progress& progress);
    Image views(const Inside& inside, const Progress& progress);
    Image rates() const;

    LightField light_field_;
    std::shared_ptr<Rays> rays_;
    std::unique_ptr<Original> original_;
    std::unique_ptr<Waves> waves_;
    double exposure_ = 1;
    std::size_t memory_;
    mutable std::mutex measured_;  // guards what becomes known while it is shown
    Array<double, 2> bytes_of_hogels_;
};

/// Samples that are read or rendered in a moment: 32 MB, a few hundredths of a second from the page cache.
inline constexpr double first_look_samples = 8e6;

/// The odd step between hogels with which a light field has so many samples; 1 where it has no more.
std::size_t step_for(const LightFieldGrid& grid, double samples);
/// The step between hogels at which a light field's samples fit into `memory` as halves.
std::size_t step_that_fits(const LightFieldGrid& grid, std::size_t memory);
/// The step for a first look, which is read in a moment; 1 where the whole is.
std::size_t step_of_first_look(const LightFieldGrid& grid);

}  // namespace hogel::view
