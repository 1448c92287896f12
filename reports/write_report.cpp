#include "reports/write_report.h"

#include <unistd.h>

#include <fstream>
#include <system_error>

#include "protocols/files/errors.h"
#include "reports/figures/report_figures.h"
#include "reports/json/results_json.h"
#include "reports/json/statistics_json.h"
#include "reports/page/page.h"
#include "reports/tables/report_tables.h"
#include "reports/tables/table_formats.h"

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

void writeAll(const StudyAnalysis& analysis, const fs::path& folder)
{
    fs::create_directories(folder / "tables");
    fs::create_directories(folder / "figures");
    write(folder / "results.json", resultsText(analysis));
    write(folder / "statistics.json", statisticsText(analysis));
    const std::vector<ReportTable> tables = reportTables(analysis);
    for (const ReportTable& one : tables) {
        write(folder / "tables" / (one.table.name + ".csv"), toCsv(one.table));
        write(folder / "tables" / (one.table.name + ".tex"), toTex(one.table));
    }
    const std::vector<Figure> figures = reportFigures(analysis);
    for (const Figure& figure : figures) write(folder / "figures" / (figure.name + ".svg"), figure.svg);
    write(folder / "index.html", reportPage(analysis, tables, figures));
}

/// A folder with files of these names that no report wrote is somebody's work.
void requireReplaceable(const fs::path& folder)
{
    if (fs::exists(folder) && !fs::is_directory(folder))
        throw protocols::badInput({"the place of the report is a file", folder.string(), "a folder, or a new name", ""});
    for (const std::string& entry : entries)
        if (fs::exists(folder / entry) && !isResultsFile(folder / "results.json"))
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

void writeReport(const StudyAnalysis& analysis, const std::filesystem::path& folder)
{
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
