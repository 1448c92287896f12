#include "rendering/models/seeing/checkpoint.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "protocols/json_count.h"

namespace rendering::models {

namespace {

using nlohmann::ordered_json;

constexpr const char* formatName = "vis2hap.checkpoint/1";

std::string stateText(const Checkpoint& checkpoint)
{
    const ordered_json json{{"fingerprint", checkpoint.fingerprint},
                            {"validation_before", checkpoint.validationBefore},
                            {"step", checkpoint.step},
                            {"best_step", checkpoint.bestStep},
                            {"best_distance", checkpoint.bestDistance},
                            {"validations_without_better", checkpoint.validationsWithoutBetter},
                            {"elapsed_s", checkpoint.elapsedS}};
    return json.dump();
}

protocols::Error unusable(const TensorSource& source, const std::string& what)
{
    return protocols::badInput({what, source.file.string(), source.expected, source.nextStep});
}

nlohmann::json jsonIn(const std::string& text, const TensorSource& source)
{
    try {
        return protocols::parseStrictJson(text, source.file.string());
    } catch (const protocols::Error&) {
        throw unusable(source, "the checkpoint is damaged");
    }
}

Checkpoint stateFrom(const std::map<std::string, std::string>& metadata, const TensorSource& source)
{
    Checkpoint checkpoint;
    try {
        if (metadata.at("format") != formatName) throw unusable(source, "the checkpoint is of another version");
        const nlohmann::json json = jsonIn(metadata.at("state"), source);
        checkpoint.fingerprint = json.at("fingerprint").get<std::string>();
        checkpoint.validationBefore = json.at("validation_before").get<std::string>();
        checkpoint.step = protocols::countIn(json, "step");
        checkpoint.bestStep = protocols::countIn(json, "best_step");
        checkpoint.bestDistance = json.at("best_distance").get<double>();
        checkpoint.validationsWithoutBetter = protocols::countIn(json, "validations_without_better");
        checkpoint.elapsedS = json.at("elapsed_s").get<double>();
        jsonIn(checkpoint.validationBefore, source);
    } catch (const nlohmann::json::exception&) {
        throw unusable(source, "the checkpoint is damaged");
    } catch (const std::out_of_range&) {
        throw unusable(source, "the checkpoint is damaged");
    }
    if (!(checkpoint.elapsedS >= 0)) throw unusable(source, "the checkpoint is damaged");
    return checkpoint;
}

}  // namespace

std::filesystem::path checkpointOf(const std::filesystem::path& model)
{
    std::filesystem::path file = model;
    file += ".checkpoint";
    return file;
}

void writeCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint, const std::vector<StoredTensor>& tensors)
{
    protocols::writeWholeFile(file, tensorFileBytes({{{"format", formatName}, {"state", stateText(checkpoint)}}, tensors}));
}

StoredRun readCheckpoint(const std::filesystem::path& file, const std::string& fingerprint, const std::vector<TensorKind>& wanted)
{
    const TensorSource source{file, "the checkpoint of an interrupted run with the same data set and options",
                              "train again without --resume"};
    if (!std::filesystem::exists(file)) throw unusable(source, "there is no checkpoint to resume from");
    refuseArchive(source);
    // The state comes first: other options explain other tensors.
    StoredRun run{stateFrom(tensorMetadata(protocols::beginningOf(file, tensorHeaderRoom), source), source), {}};
    if (run.state.fingerprint != fingerprint)
        throw unusable(source, "the checkpoint belongs to a run with another data set or other options");
    run.tensors = parseTensorFile(readTensorBytes(wanted, source), wanted, source).tensors;
    return run;
}

}  // namespace rendering::models
