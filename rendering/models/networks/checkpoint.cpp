#include "rendering/models/networks/checkpoint.h"

#include "protocols/files/errors.h"
#include "rendering/models/networks/weights.h"

namespace rendering::models {

std::filesystem::path checkpointOf(const std::filesystem::path& model)
{
    std::filesystem::path file = model;
    file += ".checkpoint";
    return file;
}

void writeCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint,
                     const std::function<void(torch::serialize::OutputArchive&)>& save)
{
    torch::serialize::OutputArchive archive;
    archive.write("fingerprint", c10::IValue(checkpoint.fingerprint));
    archive.write("validation_before", c10::IValue(checkpoint.validationBefore));
    archive.write("step", c10::IValue(static_cast<std::int64_t>(checkpoint.step)));
    archive.write("best_step", c10::IValue(static_cast<std::int64_t>(checkpoint.bestStep)));
    archive.write("best_distance", c10::IValue(checkpoint.bestDistance));
    archive.write("validations_without_better", c10::IValue(static_cast<std::int64_t>(checkpoint.validationsWithoutBetter)));
    archive.write("elapsed_s", c10::IValue(checkpoint.elapsedS));
    save(archive);
    writeArchive(file, archive);
}

Checkpoint readCheckpoint(const std::filesystem::path& file, const std::string& fingerprint,
                          const std::function<void(torch::serialize::InputArchive&)>& load)
{
    const auto refuse = [&](const std::string& what) {
        return protocols::badInput({what, file.string(),
                                    "the checkpoint of an interrupted run with the same data set and options",
                                    "train again without --resume"});
    };
    if (!std::filesystem::exists(file)) throw refuse("there is no checkpoint to resume from");
    torch::serialize::InputArchive archive = readArchive(file);
    Checkpoint checkpoint;
    try {
        c10::IValue value;
        archive.read("fingerprint", value);
        checkpoint.fingerprint = value.toStringRef();
        if (checkpoint.fingerprint != fingerprint)
            throw refuse("the checkpoint belongs to a run with another data set or other options");
        archive.read("validation_before", value);
        checkpoint.validationBefore = value.toStringRef();
        archive.read("step", value);
        checkpoint.step = static_cast<int>(value.toInt());
        archive.read("best_step", value);
        checkpoint.bestStep = static_cast<int>(value.toInt());
        archive.read("best_distance", value);
        checkpoint.bestDistance = value.toDouble();
        archive.read("validations_without_better", value);
        checkpoint.validationsWithoutBetter = static_cast<int>(value.toInt());
        archive.read("elapsed_s", value);
        checkpoint.elapsedS = value.toDouble();
        load(archive);
    } catch (const c10::Error&) {
        throw refuse("the checkpoint is damaged");
    }
    return checkpoint;
}

}  // namespace rendering::models
