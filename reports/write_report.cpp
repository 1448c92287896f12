// Puts a report on disk: everything is written into a neighbouring folder first and then swapped in,
// so that a full disk or a crash leaves the earlier report or none.
#include "reports/write_report.h"

#include <unistd.h>

#include <fstream>
#include <system_error>

#include "protocols/files/errors.h"
#include "reports/figures/report_figures.h"
#include "reports/page/page.h"
#include "reports/tables/report_tables.h"

namespace reports {
namespace {

namespace fs = std::filesystem;

// What a report consists of; nothing else in the folder is touched.
const std::vector<std::string> entries{"index.html", "results.json", "statistics.json", "tables", "figures"};

[[noreturn]] void cannotWrite(const fs::path& place, const std::string& detail)
{
    throw protocols::environmentFault({"the report cannot be written" + (detail.empty() ? "" : " (" + detail + ")"),
                                       place.string(), "a folder that can be written, and room on the disk",
                                       "choose another folder with --out"});
}

void write(const fs::path& file, const std::string& text)
{
    std::ofstream stream(file, std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream.close();
    if (!stream) cannotWrite(file, "");
}

/// Removed with all it holds when the work ends, however it ends.
class ScratchFolder {
public:
    explicit ScratchFolder(fs::path path) : m_path(std::move(path))
    {
        std::error_code error;
        fs::remove_all(m_path, error);
        if (!fs::create_directories(m_path, error) || error) cannotWrite(m_path, error.message());
    }
    ~ScratchFolder()
    {
        std::error_code ignored;
        fs::remove_all(m_path, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const fs::path& path() const { return m_path; }

private:
    fs::path m_path;
};

void writeAll(const Analysis& analysis, const fs::path& folder)
{
    fs::create_directories(folder / "tables");
    fs::create_directories(folder / "figures");
    write(folder / "results.json", analysis.results.dump(2) + "\n");
    write(folder / "statistics.json", analysis.statistics.dump(2) + "\n");
    for (const Table& table : allTables(analysis)) {
        write(folder / "tables" / (table.name + ".csv"), toCsv(table));
        write(folder / "tables" / (table.name + ".tex"), toTex(table));
    }
    const std::vector<Figure> figures = allFigures(analysis);
    for (const Figure& figure : figures) write(folder / "figures" / (figure.name + ".svg"), figure.svg);
    write(folder / "index.html", page(analysis, figures));
}

bool isOurReport(const fs::path& folder)
{
    std::ifstream stream(folder / "results.json");
    const Json results = Json::parse(stream, nullptr, false);
    return results.is_object() && results.value("schema", "") == "vis2hap.results/1";
}

/// A folder with files of these names that no report wrote is somebody's work.
void requireReplaceable(const fs::path& folder)
{
    if (fs::exists(folder) && !fs::is_directory(folder))
        throw protocols::badInput({"the place of the report is a file", folder.string(), "a folder, or a new name", ""});
    for (const std::string& entry : entries)
        if (fs::exists(folder / entry) && !isOurReport(folder))
            throw protocols::badInput({"the folder holds \"" + entry + "\" which is not of an earlier report", folder.string(),
                                       "an empty folder, a new name, or an earlier report", "choose another folder with --out"});
}

/// Moves the earlier report aside, the new one in, and back again if that fails.
void swapIn(const fs::path& fresh, const fs::path& folder, const fs::path& aside)
{
    std::vector<std::string> moved;
    std::vector<std::string> placed;
    std::error_code error;
    for (const std::string& entry : entries) {
        if (fs::exists(folder / entry)) {
            fs::rename(folder / entry, aside / entry, error);
            if (error) break;
            moved.push_back(entry);
        }
        fs::rename(fresh / entry, folder / entry, error);
        if (error) break;
        placed.push_back(entry);
    }
    if (!error) return;
    std::error_code ignored;
    for (const std::string& entry : placed) fs::remove_all(folder / entry, ignored);
    for (const std::string& entry : moved) fs::rename(aside / entry, folder / entry, ignored);
    cannotWrite(folder, error.message());
}

}  // namespace

void writeReport(const StudyData& data, const std::filesystem::path& folder)
{
    const Analysis analysis = analyse(data);
    fs::path target = fs::absolute(folder).lexically_normal();
    if (!target.has_filename())  // "report/" names the same folder as "report"
        target = target.parent_path();
    requireReplaceable(target);
    const bool isNew = !fs::exists(target);
    try {
        fs::create_directories(target);
        // Inside the target: renames then stay within one file system, even below a mount point.
        const ScratchFolder scratch(target / (".report-" + std::to_string(::getpid())));
        fs::create_directories(scratch.path() / "new");
        fs::create_directories(scratch.path() / "old");
        writeAll(analysis, scratch.path() / "new");
        swapIn(scratch.path() / "new", target, scratch.path() / "old");
    } catch (const fs::filesystem_error& error) {
        if (isNew) {
            std::error_code ignored;
            fs::remove(target, ignored);
        }
        cannotWrite(target, error.code().message());
    } catch (const protocols::Error&) {
        if (isNew) {
            std::error_code ignored;
            fs::remove(target, ignored);
        }
        throw;
    }
}

}  // namespace reports
