#include "study/shards/shard_file.h"

#include <algorithm>
#include <charconv>
#include <numeric>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"

namespace study::shards {

namespace {

using nlohmann::ordered_json;

constexpr const char* shardSchema = "vis2hap.shard/1";
constexpr const char* runAgain = "run this shard again";
/// Numbers of missing shards that a message names.
constexpr std::size_t mostNamed = 10;

/// Hash of all members but the hash itself; the order of the keys does not matter.
std::string hashOf(ordered_json file)
{
    file.erase("sha256");
    return protocols::sha256(nlohmann::json(file).dump());
}

std::optional<std::size_t> wholeNumber(std::string_view text)
{
    std::size_t number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    return read.ec == std::errc() && read.ptr == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// The name of the first option in which two runs differ.
std::string firstDifference(const ordered_json& a, const ordered_json& b)
{
    // Sorted, because an object that keeps the order of its keys looks through all of them for each.
    const nlohmann::json ofA = a, ofB = b;
    for (const auto& [name, value] : a.items())
        if (!ofB.contains(name) || ofB.at(name) != ofA.at(name)) return name;
    for (const auto& [name, value] : b.items())
        if (!ofA.contains(name)) return name;
    return {};
}

protocols::Error otherRun(const std::string& what, const std::filesystem::path& file, const std::filesystem::path& first)
{
    return protocols::badInput(
        {what, file.string(), "shards of the same run as " + first.string(), "name the files of one run only"});
}

void requireSameRun(const Shard& shard, const std::filesystem::path& file, const Shard& first,
                    const std::filesystem::path& firstFile)
{
    if (shard.command != first.command)
        throw otherRun("the shard belongs to `vis2hap " + protocols::printable(shard.command) + "`", file, firstFile);
    if (shard.share.parts != first.share.parts)
        throw otherRun(
            "the shard is one of " + std::to_string(shard.share.parts) + ", not of " + std::to_string(first.share.parts), file,
            firstFile);
    if (nlohmann::json(shard.options) != nlohmann::json(first.options))
        throw otherRun(
            "the shard was run with another \"" + protocols::printable(firstDifference(first.options, shard.options)) + "\"",
            file, firstFile);
}

/// "3, 5 and 6", the first ones of many.
std::string numbersOf(const std::vector<std::size_t>& numbers)
{
    std::string text;
    for (std::size_t i = 0; i < std::min(numbers.size(), mostNamed); ++i) {
        const bool isLast = i + 1 == numbers.size();
        text += (i == 0 ? "" : isLast ? " and " : ", ") + std::to_string(numbers[i]);
    }
    if (numbers.size() > mostNamed) text += " and " + std::to_string(numbers.size() - mostNamed) + " more";
    return text;
}

void requireAll(const ShardedRun& run)
{
    const std::size_t parts = run.shards.front().share.parts;
    std::vector<std::size_t> missing;
    std::size_t next = 0;
    for (std::size_t i = 0; i < run.shards.size(); ++i) {
        const std::size_t part = run.shards[i].share.part;
        if (i > 0 && part == run.shards[i - 1].share.part)
            throw protocols::badInput({"shard " + textOf(run.shards[i].share) + " occurs twice", run.files[i].string(),
                                       "each shard once (the other one is " + run.files[i - 1].string() + ")",
                                       "leave one of them out"});
        for (; next < part; ++next) missing.push_back(next + 1);
        next = part + 1;
    }
    for (; next < parts; ++next) missing.push_back(next + 1);
    if (missing.empty()) return;
    throw protocols::badInput({"shard " + numbersOf(missing) + " of " + std::to_string(parts) + " is missing",
                               run.files.front().parent_path().string(), "all shards from 1 to " + std::to_string(parts),
                               "run `vis2hap " + protocols::printable(run.command()) + " ... --shard " +
                                   std::to_string(missing.front()) + "/" + std::to_string(parts) + "`, and name its file, too"});
}

}  // namespace

stats::Share shareNamed(std::string_view text)
{
    const std::size_t slash = text.find('/');
    const auto part = wholeNumber(text.substr(0, slash));
    const auto parts = slash == std::string_view::npos ? std::nullopt : wholeNumber(text.substr(slash + 1));
    if (!part || !parts || *part < 1 || *part > *parts || *parts > mostShards)
        throw protocols::badInput({"\"" + protocols::printable(text) + "\" is no shard", "--shard",
                                   "K/N, K from 1 to N, N at most " + std::to_string(mostShards) + ", such as 3/16",
                                   "correct the option"});
    return {*part - 1, *parts};
}

std::string textOf(const stats::Share& share) { return std::to_string(share.part + 1) + "/" + std::to_string(share.parts); }

std::filesystem::path usualFileOf(const std::string& command, const stats::Share& share)
{
    return command + "-" + std::to_string(share.part + 1) + "-of-" + std::to_string(share.parts) + ".json";
}

void writeShard(const std::filesystem::path& file, const Shard& shard)
{
    ordered_json json{{"schema", shardSchema},    {"program", shard.program},      {"command", shard.command},
                      {"options", shard.options}, {"shard", shard.share.part + 1}, {"shards", shard.share.parts},
                      {"values", shard.values}};
    json["sha256"] = hashOf(json);
    protocols::writeWholeFile(file, json.dump(1) + "\n");
}

Shard shardFrom(std::string_view text, const std::string& where)
{
    const ordered_json json = protocols::parseStrictOrderedJson(text, where);
    if (!json.is_object() || json.value("schema", ordered_json()) != shardSchema)
        throw protocols::badInput({"the file is no shard", where, std::string("a file with the schema ") + shardSchema,
                                   "name files that --shard wrote"});
    if (json.value("sha256", ordered_json()) != hashOf(json))
        throw protocols::badInput({"the shard is damaged or was altered", where, "the content that its hash names", runAgain});
    try {
        const auto number = [&](const char* key) -> std::size_t {
            return json.at(key).get_ref<const ordered_json::number_unsigned_t&>();
        };
        const stats::Share share = shareNamed(std::to_string(number("shard")) + "/" + std::to_string(number("shards")));
        Shard shard{json.at("program").get<std::string>(), json.at("command").get<std::string>(), json.at("options"), share,
                    json.at("values")};
        if (shard.options.is_object() && shard.values.is_object()) return shard;
    } catch (const ordered_json::exception&) {
    } catch (const protocols::Error&) {
    }
    throw protocols::badInput(
        {"the shard is incomplete", where, "program, command, options, shard, shards and values", runAgain});
}

ShardedRun readRun(const std::vector<std::filesystem::path>& files, const std::string& program)
{
    ShardedRun read;
    for (const std::filesystem::path& file : files) {
        Shard shard = shardFrom(protocols::readRegularFile(file, largestShard), file.string());
        if (shard.program != program)
            throw protocols::badInput({"the shard was made by " + protocols::printable(shard.program), file.string(), program,
                                       "merge with the version that made the shards, or run them again"});
        if (!read.shards.empty()) requireSameRun(shard, file, read.shards.front(), files.front());
        read.shards.push_back(std::move(shard));
    }
    if (read.shards.empty()) throw protocols::badInput({"no shard was named", "merge", "the files of all shards", "name them"});
    std::vector<std::size_t> order(files.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return read.shards[i].share.part; });
    ShardedRun run;
    for (const std::size_t i : order) {
        run.files.push_back(files[i]);
        run.shards.push_back(std::move(read.shards[i]));
    }
    requireAll(run);
    return run;
}

}  // namespace study::shards
