#include "study/app/pages/photographs/photographs_page.h"

#include <QApplication>
#include <QFileDialog>
#include <QFontInfo>
#include <QKeyEvent>
#include <QPlainTextEdit>
#include <algorithm>

#include "study/app/language/app_text.h"
#include "study/app/language/below.h"
#include "study/app/pages/photographs/photograph_list.h"
#include "study/app/pages/photographs/photograph_scale.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

namespace fs = std::filesystem;

QString textOf(const fs::path& path) { return QString::fromStdString(path.string()); }

fs::path pathIn(const QLineEdit& line)
{
    const fs::path typed = line.text().trimmed().toStdString();
    return typed.empty() ? typed : fs::absolute(typed).lexically_normal();
}

/// The first faults, one a line.
QString joined(const QStringList& faults)
{
    constexpr int mostLines = 4;
    if (faults.size() <= mostLines) return faults.join(QLatin1Char('\n'));
    return faults.mid(0, mostLines - 1).join(QLatin1Char('\n')) + QLatin1Char('\n') +
           PhotographsPage::tr("%1 more files were refused.").arg(faults.size() - mostLines + 1);
}

bool isDarkNow()
{
    constexpr int halfLight = 128;
    return QApplication::palette().color(QPalette::Window).lightness() < halfLight;
}

}  // namespace

PhotographsPage::PhotographsPage(PhotographSteps steps, QWidget* parent)
    : QWidget(parent), m_steps(std::move(steps)), m_form(*this), m_work(*this)
{
    setObjectName("photographsPage");
    connectSteps();
    changed();
}

PhotographsPage::~PhotographsPage()
{
    // The workers report to the widgets of this page, so stop them before the widgets are destroyed.
    m_work.stop();
    m_viewing.stop();
}

void PhotographsPage::connectSteps()
{
    connect(m_form.place, &QLineEdit::textChanged, m_form.placeMessage, &MessageBar::clearMessage);
    connect(m_form.add, &QPushButton::clicked, this, [this] { add(m_form.place->text()); });
    connect(m_form.browseFiles, &QPushButton::clicked, this, &PhotographsPage::browseFiles);
    connect(m_form.browseFolder, &QPushButton::clicked, this, &PhotographsPage::browseFolder);
    connect(m_form.list, &PhotographList::changed, this, &PhotographsPage::changed);
    connect(m_form.list, &PhotographList::photographChosen, this, &PhotographsPage::view);
    connect(m_form.scale, &PhotographScale::changed, this, &PhotographsPage::changed);
    connect(m_form.check, &QPushButton::clicked, this, &PhotographsPage::check);
    connect(m_form.target, &QLineEdit::textChanged, m_form.targetMessage, &MessageBar::clearMessage);
    connect(m_form.target, &QLineEdit::textEdited, this,
            [this](const QString& text) { m_isTargetTyped = !text.trimmed().isEmpty(); });
    connect(m_form.browseTarget, &QPushButton::clicked, this, &PhotographsPage::browseTarget);
    connect(m_form.write, &QPushButton::clicked, this, &PhotographsPage::write);
    connect(m_form.draw, &QPushButton::clicked, this, &PhotographsPage::draw);
    for (QPushButton* condition : m_form.conditions)
        for (MessageBar* message : {m_form.drawMessage, m_form.studyMessage})
            connect(condition, &QPushButton::clicked, message, &MessageBar::clearMessage);
    connect(m_form.toStudy, &QPushButton::clicked, this, &PhotographsPage::plan);
    connect(&m_work, &StepWork::busyChanged, this, &PhotographsPage::enable);
    connect(m_form.back, &QPushButton::clicked, this, &PhotographsPage::goBack);
}

void PhotographsPage::focusFirst() { m_form.place->setFocus(); }

void PhotographsPage::browseFiles()
{
    const QStringList chosen = QFileDialog::getOpenFileNames(this, tr("Photographs"), m_form.place->text(),
                                                             tr("Images (*.png *.jpg *.jpeg *.bmp *.tif *.tiff);;All files (*)"));
    std::vector<fs::path> files;
    for (const QString& file : chosen) files.emplace_back(file.toStdString());
    addAll(files);
}

void PhotographsPage::browseFolder()
{
    const QString chosen = QFileDialog::getExistingDirectory(this, tr("Folder of photographs"), m_form.place->text());
    if (!chosen.isEmpty()) add(chosen);
}

void PhotographsPage::browseTarget()
{
    const QString chosen = QFileDialog::getExistingDirectory(this, tr("Folder that receives the data set"));
    if (chosen.isEmpty()) return;
    m_isTargetTyped = true;
    m_form.target->setText(chosen + QStringLiteral("/fabrics"));
}

void PhotographsPage::add(const QString& place)
{
    m_form.placeMessage->clearMessage();
    if (place.trimmed().isEmpty()) {
        m_form.place->setFocus();
        return m_form.placeMessage->showHint(tr("No photograph is given. Type a file or folder, or choose it with Browse."));
    }
    addAll({fs::absolute(place.trimmed().toStdString()).lexically_normal()});
}

void PhotographsPage::addAll(const std::vector<fs::path>& places)
{
    if (places.empty()) return;
    m_work.run(*m_form.placeMessage, tr("The program reads the photographs. Esc stops it."),
               [this, places, steps = m_steps](const ToolProgress& progress) -> InBackground::Then {
                   std::vector<fs::path> files;
                   QStringList faults;
                   const auto refusing = [&faults](const auto& work) {
                       try {
                           work();
                       } catch (const StepStopped&) {
                           throw;
                       } catch (const std::exception& fault) {
                           faults << inOwnLanguage(fault.what());
                       }
                   };
                   for (const fs::path& place : places)
                       refusing([&] {
                           const auto found = steps.find(place);
                           files.insert(files.end(), found.begin(), found.end());
                       });
                   std::vector<PhotographList::Photograph> read;
                   for (std::size_t i = 0; i < files.size(); ++i) {
                       progress(1.0 * static_cast<double>(i) / static_cast<double>(files.size()), files[i].filename().string());
                       constexpr int tinyPx = 32;  // only the size and the faults of the file are needed here
                       refusing([&] { read.push_back({files[i], steps.see(files[i], tinyPx).sizePx}); });
                   }
                   return [this, read, faults] {
                       m_form.list->add(read);
                       if (!faults.isEmpty()) {
                           m_form.placeMessage->showFault(joined(faults));
                           return m_form.place->setFocus();
                       }
                       m_form.placeMessage->clearMessage();
                       m_form.place->clear();
                       if (m_form.list->hasGoodNames()) m_form.list->focusFirst();
                   };
               });
}

void PhotographsPage::view()
{
    const auto* chosen = m_form.list->chosen();
    m_isViewedAgain = m_viewing.isBusy();  // the chosen one is then read after the current one
    if (!chosen || m_isViewedAgain) return;
    constexpr int mostPx = 1600;
    m_viewing.run(
        [this, file = chosen->file, see = m_steps.see](const std::atomic<bool>&) -> InBackground::Then {
            return [this, file, seen = see(file, mostPx)] {
                if (m_isViewedAgain) return view();
                m_form.scale->setPhotograph(seen.picture, seen.sizePx, textOf(file.filename()));
            };
        },
        [this](const QString& why) {
            if (m_isViewedAgain) return view();
            m_form.placeMessage->showFault(why);
        });
}

std::optional<PhotographSet> PhotographsPage::goodSet()
{
    if (!m_form.list->hasGoodNames() || !m_form.scale->isValid()) return std::nullopt;
    return PhotographSet{m_form.list->named(), m_form.scale->mmPerPixel()};
}

void PhotographsPage::check()
{
    const auto set = goodSet();
    if (!set) return;
    m_form.warnings->hide();
    m_work.run(*m_form.checkMessage, tr("The program compares the photographs with those it knows."),
               [this, set = *set, check = m_steps.check](const ToolProgress& progress) -> InBackground::Then {
                   return [this, warnings = check(set, progress)] { showWarnings(warnings); };
               });
}

void PhotographsPage::showWarnings(const std::vector<QStringList>& warnings)
{
    m_form.list->showWarnings(warnings);
    QStringList lines;
    int concerned = 0;
    for (const QStringList& ofOne : warnings) {
        lines << ofOne;
        concerned += ofOne.isEmpty() ? 0 : 1;
    }
    m_form.warnings->setPlainText(lines.join(QLatin1Char('\n')));
    m_form.warnings->setVisible(!lines.isEmpty());
    m_form.warnings->setFixedHeight(m_form.warnings->fontMetrics().height() * std::clamp(3 + 2 * concerned, 4, 9));
    if (lines.isEmpty())
        m_form.checkMessage->showDone(tr("No warnings. The photographs resemble those that the networks learned from."));
    else
        m_form.checkMessage->showHint(
            tr("%1 of %2 photographs have warnings. You may go on, or take them again.").arg(concerned).arg(warnings.size()));
    m_form.target->setFocus();
}

void PhotographsPage::write()
{
    m_form.targetMessage->clearMessage();
    const fs::path folder = pathIn(*m_form.target);
    const auto set = goodSet();
    if (!set) return;
    if (folder.empty()) {
        m_form.target->setFocus();
        return m_form.targetMessage->showHint(tr("No folder is given. Type a folder that does not exist yet."));
    }
    m_work.run(*m_form.targetMessage, tr("The program writes the data set."),
               [this, folder, set = *set, fabrics = m_form.list->fabricCount(),
                write = m_steps.write](const ToolProgress& progress) -> InBackground::Then {
                   write(set, folder, progress);
                   return [this, folder, fabrics, photographs = set.photographs.size()] {
                       m_dataset = folder;
                       m_form.targetMessage->showDone(
                           tr("Written: %1 (fabrics: %2, photographs: %3)").arg(textOf(folder)).arg(fabrics).arg(photographs));
                       enable();
                       m_form.draw->setFocus();
                   };
               });
}

std::vector<std::string> PhotographsPage::chosenConditions()
{
    auto conditions = m_form.chosenConditions();
    if (conditions.empty()) {
        m_form.conditions.front()->setFocus();
        m_form.drawMessage->showHint(tr("No condition is chosen. Choose one or more of the five."));
    }
    return conditions;
}

void PhotographsPage::plan()
{
    const auto conditions = chosenConditions();
    if (conditions.empty()) return;
    m_work.run(*m_form.studyMessage, tr("The program writes the protocol."),
               [this, conditions, dataset = m_dataset, plan = m_steps.plan,
                language = languageOfWindow().toStdString()](const ToolProgress&) -> InBackground::Then {
                   return [this, dataset, protocol = plan(dataset, conditions, language)] {
                       m_form.studyMessage->clearMessage();
                       Q_EMIT studyRequested(textOf(dataset), textOf(protocol));
                   };
               });
}

void PhotographsPage::draw()
{
    FrictionPictureRequest request{.dataset = m_dataset, .conditions = chosenConditions(), .captions = {}};
    if (request.conditions.empty()) return;
    for (const QPushButton* condition : m_form.conditions)
        if (condition->isChecked()) request.captions << condition->text();
    request.theme = isDarkNow() ? Theme::DarkRoom : Theme::Light;
    request.widthPx = m_form.target->parentWidget()->width();
    request.fontPx = QFontInfo(QApplication::font()).pixelSize() * factorOf(Type::Plain);
    request.pixelRatio = devicePixelRatioF();
    m_work.run(*m_form.drawMessage, tr("The program renders the friction images. This can take minutes."),
               [this, request, draw = m_steps.draw](const ToolProgress& progress) -> InBackground::Then {
                   return [this, request, picture = draw(request, progress)] {
                       m_form.drawMessage->clearMessage();
                       m_drawn = picture;
                       showPicture();
                       m_form.picture->setAccessibleName(tr("Friction images: %1").arg(request.captions.join(listMark())));
                       m_form.picture->show();
                       m_form.toStudy->setFocus();  // it stands below the picture, so the page scrolls to both
                   };
               });
}

void PhotographsPage::showPicture()
{
    const int room = static_cast<int>(m_form.target->parentWidget()->width() * m_drawn.devicePixelRatio());
    if (!m_drawn.isNull())
        m_form.picture->setPixmap(
            QPixmap::fromImage(m_drawn.width() > room ? m_drawn.scaledToWidth(room, Qt::SmoothTransformation) : m_drawn));
}

void PhotographsPage::resizeEvent(QResizeEvent* event)
{
    QWidget::resizeEvent(event);
    QMetaObject::invokeMethod(this, &PhotographsPage::showPicture, Qt::QueuedConnection);  // after the layout
}

void PhotographsPage::changed()
{
    m_dataset.clear();  // what was written stays on the disk, but is no longer what the page shows
    m_form.targetMessage->clearMessage();
    m_form.checkMessage->clearMessage();
    m_form.drawMessage->clearMessage();
    m_form.studyMessage->clearMessage();
    m_form.warnings->hide();
    m_form.picture->hide();
    m_form.list->showWarnings({});
    proposeFolder();
    enable();
}

void PhotographsPage::proposeFolder()
{
    const auto* first = m_form.list->chosen();
    std::error_code unknown;
    const bool isTaken = fs::exists(pathIn(*m_form.target), unknown);
    if (!first || (m_isTargetTyped && !isTaken)) return;
    const fs::path beside = first->file.parent_path();
    fs::path free = beside.string() + "-fabrics";
    for (int number = 2; fs::exists(free, unknown); ++number) free = beside.string() + "-fabrics-" + std::to_string(number);
    m_form.target->setText(textOf(free));
}

void PhotographsPage::enable()
{
    const bool isFree = !m_work.isBusy(), hasPhotographs = !m_form.list->isEmpty(), isWritten = !m_dataset.empty();
    for (QWidget* part : std::initializer_list<QWidget*>{m_form.place, m_form.browseFiles, m_form.browseFolder, m_form.add,
                                                         m_form.list, m_form.scale})
        part->setEnabled(isFree);
    for (QWidget* part : std::initializer_list<QWidget*>{m_form.check, m_form.target, m_form.browseTarget, m_form.write})
        part->setEnabled(isFree && hasPhotographs);
    for (QWidget* part : m_form.conditions) part->setEnabled(isFree && isWritten);
    for (QWidget* part : {m_form.draw, m_form.toStudy}) part->setEnabled(isFree && isWritten);
    m_form.scale->setVisible(hasPhotographs);
    setButtonText(*m_form.back, isFree ? tr("Back (Esc)") : tr("Stop (Esc)"));
}

void PhotographsPage::goBack()
{
    if (m_work.isBusy())
        m_work.askToStop();
    else
        Q_EMIT backRequested();
}

void PhotographsPage::keyPressEvent(QKeyEvent* event)
{
    auto* pressed = qobject_cast<QPushButton*>(focusWidget());
    const bool isEnter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (event->key() == Qt::Key_Escape)
        goBack();
    else if (isEnter && pressed)
        pressed->click();
    else if (isEnter && focusWidget() == m_form.place)
        add(m_form.place->text());
    else if (isEnter && focusWidget() == m_form.target)
        write();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
