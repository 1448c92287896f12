// Whether two trainings may be compared: a control is fair where nothing but its losses differs from the model's training.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "rendering/models/model_card_fields.h"

namespace rendering::models {

/// Differences between the training of a control and of a model, each as a clause such as "800 steps (the model: 6,000)": steps,
/// kind of networks, model to start from, data set, split, fabrics held out, width of the networks, crop, batch, learning rate
/// and its fall, interval between validations. Empty where the control is fair. Seeds, losses and stopping rules do not count.
std::vector<std::string> trainingDifferences(const ModelCardFields& model, const ModelCardFields& control);

/// Options of `vis2hap train` that train a fair L1-only control of the model, name and value. They include the steps over
/// which the model's learning rate falls, and where it stopped before them, the step at which the control stops, too; for a model
/// of a data set also a patience that lets the control take all of them. A flag has an empty value.
std::vector<std::pair<std::string, std::string>> controlOptions(const ModelCardFields& model);

}  // namespace rendering::models
