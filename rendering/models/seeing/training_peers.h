// The processes that train one model together, on one or several machines: c10d with Gloo over TCP. Every call is one that all
// processes make in the same order. The network is trusted: nothing is encrypted, and whoever reaches the port can take part.
// Only the torch sources include it.
#pragma once

#include <torch/torch.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rendering/models/seeing/training_place.h"

namespace rendering::models {

/// Names and values that must agree among the processes: options, data, version.
using AgreedSettings = std::vector<std::pair<std::string, std::string>>;

class TrainingPeers {
public:
    /// Meets the other processes. Throws badInput where the settings differ or a rank is taken, naming the setting in every
    /// process; environmentFault where the processes do not meet within the wait.
    TrainingPeers(const TrainingPlace& place, AgreedSettings settings);
    ~TrainingPeers();
    TrainingPeers(const TrainingPeers&) = delete;
    TrainingPeers& operator=(const TrainingPeers&) = delete;

    const TrainingPlace& place() const { return m_place; }

    /// Replaces the numbers by their sums over all processes; all processes get the same bits. Throws workFailed where another
    /// process has ended, or does not answer within the wait.
    void sum(torch::Tensor& numbers) const;
    /// Replaces the numbers by those of rank 0. Throws as sum() does.
    void takeFromFirst(torch::Tensor& numbers) const;
    void takeFromFirst(std::string& bytes) const;  ///< of equal length in all processes

private:
    struct Group;

    TrainingPlace m_place;
    std::unique_ptr<Group> m_group;
};

}  // namespace rendering::models
