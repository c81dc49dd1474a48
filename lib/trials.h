// Configurations tried on a pilot: the error that each is predicted to have.
#pragma once

#include <array>
#include <map>

#include "choose_configuration.h"
#include "pilot.h"

namespace smx {

class Trials {
  public:
    Trials(const std::optional<ChoiceTable> &table, const std::vector<const Material *> &materials, const Scene &scene,
           Pilot pilot);

    // Of a table, by as many samples as bring the standard error to `target`, or by most_spp; asked for before errors
    // are. May be asked for again.
    void find_truth(double target, std::uint32_t most_spp);

    // Whether what was tried before leaves no hope that this one's error is at most `limit`.
    bool is_hopeless(const Configuration &configuration, double limit) const;

    // Of references of too many samples to be tried: extrapolated.
    double error(const Configuration &configuration);

    // The same without trying a reference that was not: none where nothing is known of its sampler.
    std::optional<double> known_error(const Configuration &configuration);

    std::size_t pixels() const { return pilot_.count(); }
    double truth_error() const { return truth_error_; } // negative: without a table

    // Seconds of this device over those of the constants' (configuration.h), from what took longest: the truth, or the
    // first material's highest order. 1 before that, and where the queue does not tell the time.
    double device_speed() const { return device_speed_; }
    double kernel_seconds() const { return kernel_seconds_; }

  private:
    struct Tried {
        std::uint32_t spp = 0;
        double error = 0.0;
        bool is_finest = false; // more samples would not be told from the truth
    };

    const PilotValues &counted(const PilotValues &values);
    void set_speed(const PilotValues &values);
    void try_reference(Sampler sampler, std::uint32_t spp);
    double reference_error(const Configuration &configuration);
    double filtered_error(const Configuration &configuration);
    double extrapolated(Sampler sampler, std::uint32_t spp) const;
    const PilotValues &finest(std::size_t material);

    const std::optional<ChoiceTable> &table_;
    const std::vector<const Material *> &materials_;
    const Scene &scene_;
    Pilot pilot_;
    PilotValues truth_;
    double truth_error_ = -1.0;
    std::array<Tried, 3> tried_;                // by sampler, the finest
    std::map<std::size_t, PilotValues> finest_; // by material, of the highest order: without a table
    double kernel_seconds_ = 0.0, device_speed_ = 1.0;
};

} // namespace smx
