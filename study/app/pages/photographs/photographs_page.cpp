#include "study/app/pages/photographs/photographs_page.h"

#include <QApplication>
#include <QFileDialog>
#include <QFontInfo>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QPlainTextEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <QShortcut>
#include <QVBoxLayout>
#include <algorithm>
#include <stdexcept>

#include "study/app/pages/photographs/photograph_list.h"
#include "study/app/pages/photographs/photograph_scale.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

namespace fs = std::filesystem;

/// Conditions that need photographs only.
struct OfferedCondition {
    const char* id;
    const char* name;
    bool isChosen;
};
constexpr OfferedCondition offeredConditions[] = {
    {"v_grey", QT_TRANSLATE_NOOP("study::app::PhotographsPage", "Grey photograph"), false},
    {"v_shape", QT_TRANSLATE_NOOP("study::app::PhotographsPage", "Shape from shading"), false},
    {"h_g", QT_TRANSLATE_NOOP("study::app::PhotographsPage", "Generated height"), false},
    {"f_g", QT_TRANSLATE_NOOP("study::app::PhotographsPage", "Generated friction"), false},
    {"h_g&f_g", QT_TRANSLATE_NOOP("study::app::PhotographsPage", "Generated height and friction"), true}};

struct StepStopped : std::runtime_error {
    StepStopped() : std::runtime_error(PhotographsPage::tr("Stopped. Nothing was written.").toStdString()) {}
};

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
    : QWidget(parent),
      m_steps(std::move(steps)),
      m_place(field("photographsField", tr("Photograph or folder"), this)),
      m_browseFiles(button("browsePhotographsButton", tr("Browse files…"), this)),
      m_browseFolder(button("browsePhotographFolderButton", tr("Browse folders…"), this)),
      m_add(mainButton("addPhotographsButton", tr("Add (Enter)"), this)),
      m_placeMessage(new MessageBar("photographsMessage", this)),
      m_list(new PhotographList(this)),
      m_scale(new PhotographScale(this)),
      m_check(button("checkPhotographsButton", tr("Check the photographs"), this)),
      m_checkMessage(new MessageBar("photographCheckMessage", this)),
      m_warnings(new QPlainTextEdit(this)),
      m_target(field("newDatasetField", tr("Folder of the new data set"), this)),
      m_browseTarget(button("browseNewDatasetButton", tr("Browse…"), this)),
      m_write(mainButton("writeDatasetButton", tr("Write the data set"), this)),
      m_targetMessage(new MessageBar("newDatasetMessage", this)),
      m_draw(button("drawFrictionImagesButton", tr("Render"), this)),
      m_drawMessage(new MessageBar("frictionImagesMessage", this)),
      m_picture(new QLabel(this)),
      m_study(mainButton("photographsToStudyButton", tr("Go on to the new study"), this)),
      m_studyMessage(new MessageBar("photographsStudyMessage", this)),
      m_back(button("photographsBackButton", tr("Back (Esc)"), this))
{
    setObjectName("photographsPage");
    for (int number = 1; const OfferedCondition& offered : offeredConditions) {
        m_conditions.push_back(button(qPrintable(QStringLiteral("conditionButton%1").arg(number++)), tr(offered.name), this));
        m_conditions.back()->setCheckable(true);
        m_conditions.back()->setChecked(offered.isChosen);
    }
    build();
    connectSteps();
    changed();
}

PhotographsPage::~PhotographsPage()
{
    // The workers report to the widgets of this page, so stop them before the widgets are destroyed.
    m_work.stop();
    m_viewing.stop();
}

void PhotographsPage::addStep(QVBoxLayout& column, const char* objectName, const QString& title, const QString& sentence)
{
    column.addSpacing(20);
    auto* head = label(objectName, Type::Lead, this, Weight::Bold);
    head->setText(title);
    column.addWidget(head);
    auto* text = quietLabel(qPrintable(QLatin1String(objectName) + QLatin1String("Sentence")), this, Type::Plain);
    text->setText(sentence);
    column.addWidget(text);
}

void PhotographsPage::build()
{
    auto* page = new QWidget(this);
    auto* title = label("photographsTitle", Type::Title, page, Weight::Bold);
    title->setText(tr("Data set from photographs"));
    auto* column = new QVBoxLayout(page);
    column->setSpacing(8);
    column->addWidget(title);
    buildPhotographs(*column);
    buildResults(*column);
    column->addLayout(actionsRow({m_study}));
    column->addWidget(m_studyMessage);
    column->addStretch(1);
    column->addWidget(appearanceHint(page));
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    auto* area = scrolling("photographsArea", page, this);
    page->setProperty("scrollsAlways", true);  // page_fit.h
    outer->setSpacing(0);
    outer->addWidget(area, 1);
    // Outside the area, so that long work can be stopped from every place of the page.
    auto* bar = new QFrame(this);
    bar->setObjectName("photographsBar");
    setRole(*bar, "bar");
    auto* barRow = new QHBoxLayout(bar);
    barRow->setContentsMargins(28, 8, 28, 8);
    barRow->addWidget(m_back);
    barRow->addStretch(1);
    outer->addWidget(bar);
    for (const auto& [key, step] : {std::pair(Qt::Key_Up, -1), std::pair(Qt::Key_Down, +1)}) {
        auto* shortcut = new QShortcut(QKeySequence(Qt::CTRL | key), this);
        shortcut->setContext(Qt::WidgetWithChildrenShortcut);
        connect(shortcut, &QShortcut::activated, this,
                [bar = area->verticalScrollBar(), step = step] { bar->setValue(bar->value() + step * bar->pageStep() / 3); });
    }
    setTabOrder(m_place, m_browseFiles);
    setTabOrder(m_browseFiles, m_browseFolder);
    setTabOrder(m_browseFolder, m_add);
    setTabOrder(m_add, m_list->findChild<QWidget*>("byFileButton"));
    setTabOrderAfter(*m_list, {m_scale->findChild<QWidget*>("pixelWidthField")});
    setTabOrderAfter(*m_scale, {m_check, m_warnings, m_target, m_browseTarget, m_write, m_conditions.front()});
    for (std::size_t i = 1; i < m_conditions.size(); ++i) setTabOrder(m_conditions[i - 1], m_conditions[i]);
    setTabOrder(m_conditions.back(), m_draw);
    setTabOrder(m_draw, m_study);
    setTabOrder(m_study, m_back);
}

void PhotographsPage::buildPhotographs(QVBoxLayout& column)
{
    addStep(column, "stepPhotographs", tr("1  Photographs"),
            tr("Take all pictures with one camera, from straight above, at the same distance. Lay a ruler into one of them."));
    m_place->setPlaceholderText(tr("an image file, or a folder with images"));
    auto* row = new QHBoxLayout;
    row->setSpacing(10);
    row->addWidget(m_place, 1);
    column.addLayout(row);
    column.addWidget(m_placeMessage);
    column.addLayout(actionsRow({m_add, m_browseFiles, m_browseFolder}));
    column.addWidget(m_list);
    addStep(column, "stepScale", tr("2  Scale"),
            tr("One scale holds for all photographs. Give one of the three lengths, or leave them if you do not know it."));
    column.addWidget(m_scale);
}

void PhotographsPage::buildResults(QVBoxLayout& column)
{
    name(*m_warnings, "photographWarnings", tr("Warnings about the photographs"));
    setType(*m_warnings, Type::Plain);
    m_warnings->setReadOnly(true);
    m_warnings->setTabChangesFocus(true);
    m_warnings->hide();
    m_picture->setObjectName("frictionImages");
    m_picture->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    m_picture->setMinimumWidth(1);  // the picture follows the page, not the page the picture
    m_picture->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_picture->hide();
    addStep(column, "stepCheck", tr("3  Check"),
            tr("Does each photograph resemble those that the networks learned from? Otherwise height and friction are guesses."));
    column.addLayout(actionsRow({m_check}));
    column.addWidget(m_checkMessage);
    column.addWidget(m_warnings);
    addStep(column, "stepDataset", tr("4  Data set"), tr("The program makes this folder. Nothing that exists is overwritten."));
    auto* row = new QHBoxLayout;
    row->setSpacing(10);
    row->addWidget(m_target, 1);
    row->addWidget(m_browseTarget);
    m_target->setPlaceholderText(tr("a folder that does not exist yet"));
    column.addLayout(row);
    column.addWidget(m_targetMessage);
    column.addLayout(actionsRow({m_write}));
    addStep(
        column, "stepImages", tr("5  Conditions and friction images"),
        tr("Choose the conditions. If you wish, look at the images that participants will feel: bright means high friction."));
    auto* conditions = new FlowLayout(10, 8);
    for (QPushButton* condition : m_conditions) conditions->addWidget(condition);
    column.addLayout(conditions);
    column.addLayout(actionsRow({m_draw}));
    column.addWidget(m_drawMessage);
    column.addWidget(m_picture);
    addStep(
        column, "stepStudy", tr("6  Study"),
        tr("The program writes a protocol beside the data set: the questions of the paper under the chosen conditions. You may "
           "edit it."));
}

void PhotographsPage::connectSteps()
{
    connect(m_place, &QLineEdit::textChanged, m_placeMessage, &MessageBar::clearMessage);
    connect(m_add, &QPushButton::clicked, this, [this] { add(m_place->text()); });
    connect(m_browseFiles, &QPushButton::clicked, this, &PhotographsPage::browseFiles);
    connect(m_browseFolder, &QPushButton::clicked, this, &PhotographsPage::browseFolder);
    connect(m_list, &PhotographList::changed, this, &PhotographsPage::changed);
    connect(m_list, &PhotographList::photographChosen, this, &PhotographsPage::view);
    connect(m_scale, &PhotographScale::changed, this, &PhotographsPage::changed);
    connect(m_check, &QPushButton::clicked, this, &PhotographsPage::check);
    connect(m_target, &QLineEdit::textChanged, m_targetMessage, &MessageBar::clearMessage);
    connect(m_target, &QLineEdit::textEdited, this, [this](const QString& text) { m_isTargetTyped = !text.trimmed().isEmpty(); });
    connect(m_browseTarget, &QPushButton::clicked, this, &PhotographsPage::browseTarget);
    connect(m_write, &QPushButton::clicked, this, &PhotographsPage::write);
    connect(m_draw, &QPushButton::clicked, this, &PhotographsPage::draw);
    for (QPushButton* condition : m_conditions)
        for (MessageBar* message : {m_drawMessage, m_studyMessage})
            connect(condition, &QPushButton::clicked, message, &MessageBar::clearMessage);
    connect(m_study, &QPushButton::clicked, this, &PhotographsPage::plan);
    connect(m_back, &QPushButton::clicked, this, &PhotographsPage::goBack);
}

void PhotographsPage::focusFirst() { m_place->setFocus(); }

void PhotographsPage::browseFiles()
{
    const QStringList chosen = QFileDialog::getOpenFileNames(
        this, tr("Photographs"), m_place->text(), tr("Images (*.png *.jpg *.jpeg *.bmp *.tif *.tiff *.webp);;All files (*)"));
    std::vector<fs::path> files;
    for (const QString& file : chosen) files.emplace_back(file.toStdString());
    addAll(files);
}

void PhotographsPage::browseFolder()
{
    const QString chosen = QFileDialog::getExistingDirectory(this, tr("Folder of photographs"), m_place->text());
    if (!chosen.isEmpty()) add(chosen);
}

void PhotographsPage::browseTarget()
{
    const QString chosen = QFileDialog::getExistingDirectory(this, tr("Folder that receives the data set"));
    if (chosen.isEmpty()) return;
    m_isTargetTyped = true;
    m_target->setText(chosen + QStringLiteral("/fabrics"));
}

void PhotographsPage::add(const QString& place)
{
    m_placeMessage->clearMessage();
    if (place.trimmed().isEmpty()) {
        m_place->setFocus();
        return m_placeMessage->showHint(tr("No photograph is given. Type a file or folder, or choose it with Browse."));
    }
    addAll({fs::absolute(place.trimmed().toStdString()).lexically_normal()});
}

void PhotographsPage::addAll(const std::vector<fs::path>& places)
{
    if (places.empty()) return;
    run(*m_placeMessage, tr("The program reads the photographs. Esc stops it."),
        [this, places, steps = m_steps](const ToolProgress& progress) -> InBackground::Then {
            std::vector<fs::path> files;
            QStringList faults;
            const auto refusing = [&faults](const auto& work) {
                try {
                    work();
                } catch (const StepStopped&) {
                    throw;
                } catch (const std::exception& fault) {
                    faults << QString::fromUtf8(fault.what());
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
                m_list->add(read);
                if (!faults.isEmpty()) {
                    m_placeMessage->showFault(joined(faults));
                    return m_place->setFocus();
                }
                m_placeMessage->clearMessage();
                m_place->clear();
                if (m_list->hasGoodNames()) m_list->focusFirst();
            };
        });
}

void PhotographsPage::view()
{
    const auto* chosen = m_list->chosen();
    m_isViewedAgain = m_viewing.isBusy();  // the chosen one is then read after the current one
    if (!chosen || m_isViewedAgain) return;
    constexpr int mostPx = 1600;
    m_viewing.run(
        [this, file = chosen->file, see = m_steps.see](const std::atomic<bool>&) -> InBackground::Then {
            return [this, file, seen = see(file, mostPx)] {
                if (m_isViewedAgain) return view();
                m_scale->setPhotograph(seen.picture, seen.sizePx, textOf(file.filename()));
            };
        },
        [this](const QString& why) {
            if (m_isViewedAgain) return view();
            m_placeMessage->showFault(why);
        });
}

std::optional<PhotographSet> PhotographsPage::goodSet()
{
    if (!m_list->hasGoodNames() || !m_scale->isValid()) return std::nullopt;
    return PhotographSet{m_list->named(), m_scale->mmPerPixel()};
}

void PhotographsPage::run(MessageBar& message, const QString& doing, Step step)
{
    if (m_work.isBusy()) return;
    QWidget* from = focusWidget();
    m_work.run(
        [this, &message, step = std::move(step)](const std::atomic<bool>& isStopping) -> InBackground::Then {
            const auto progress = [this, &message, &isStopping](double fraction, const std::string& what) {
                if (isStopping) throw StepStopped();
                const QString text =
                    tr("%1: %2 %. Esc stops it.").arg(QString::fromStdString(what)).arg(static_cast<int>(100 * fraction));
                QMetaObject::invokeMethod(
                    this,
                    [this, &message, text] {
                        if (m_work.isBusy()) message.showDone(text);
                    },
                    Qt::QueuedConnection);
            };
            const auto then = step(progress);
            return [this, then] {
                enable();
                then();
            };
        },
        [this, &message, from](const QString& why) {
            enable();
            if (from) from->setFocus();
            if (why == QString::fromUtf8(StepStopped().what()))
                message.showHint(why);
            else
                message.showFault(why);
        });
    setFocus();  // The page keeps its place. A disabled control would pass the focus on, and the page would scroll there.
    message.showDone(doing);
    enable();
}

void PhotographsPage::check()
{
    const auto set = goodSet();
    if (!set) return;
    m_warnings->hide();
    run(*m_checkMessage, tr("The program compares the photographs with those it knows."),
        [this, set = *set, check = m_steps.check](const ToolProgress& progress) -> InBackground::Then {
            return [this, warnings = check(set, progress)] { showWarnings(warnings); };
        });
}

void PhotographsPage::showWarnings(const std::vector<QStringList>& warnings)
{
    m_list->showWarnings(warnings);
    QStringList lines;
    int concerned = 0;
    for (const QStringList& ofOne : warnings) {
        lines << ofOne;
        concerned += ofOne.isEmpty() ? 0 : 1;
    }
    m_warnings->setPlainText(lines.join(QLatin1Char('\n')));
    m_warnings->setVisible(!lines.isEmpty());
    m_warnings->setFixedHeight(m_warnings->fontMetrics().height() * std::clamp(3 + 2 * concerned, 4, 9));
    if (lines.isEmpty())
        m_checkMessage->showDone(tr("No warnings. The photographs resemble those that the networks learned from."));
    else
        m_checkMessage->showHint(
            tr("%1 of %2 photographs have warnings. You may go on, or take them again.").arg(concerned).arg(warnings.size()));
    m_target->setFocus();
}

void PhotographsPage::write()
{
    m_targetMessage->clearMessage();
    const fs::path folder = pathIn(*m_target);
    const auto set = goodSet();
    if (!set) return;
    if (folder.empty()) {
        m_target->setFocus();
        return m_targetMessage->showHint(tr("No folder is given. Type a folder that does not exist yet."));
    }
    run(*m_targetMessage, tr("The program writes the data set."),
        [this, folder, set = *set, fabrics = m_list->fabricCount(),
         write = m_steps.write](const ToolProgress& progress) -> InBackground::Then {
            write(set, folder, progress);
            return [this, folder, fabrics, photographs = set.photographs.size()] {
                m_dataset = folder;
                m_targetMessage->showDone(
                    tr("Written: %1 (fabrics: %2, photographs: %3)").arg(textOf(folder)).arg(fabrics).arg(photographs));
                enable();
                m_draw->setFocus();
            };
        });
}

std::vector<std::string> PhotographsPage::chosenConditions()
{
    std::vector<std::string> conditions;
    for (std::size_t i = 0; i < m_conditions.size(); ++i)
        if (m_conditions[i]->isChecked()) conditions.emplace_back(offeredConditions[i].id);
    if (conditions.empty()) {
        m_conditions.front()->setFocus();
        m_drawMessage->showHint(tr("No condition is chosen. Choose one or more of the five."));
    }
    return conditions;
}

void PhotographsPage::plan()
{
    const auto conditions = chosenConditions();
    if (conditions.empty()) return;
    run(*m_studyMessage, tr("The program writes the protocol."),
        [this, conditions, dataset = m_dataset, plan = m_steps.plan](const ToolProgress&) -> InBackground::Then {
            return [this, dataset, protocol = plan(dataset, conditions)] {
                m_studyMessage->clearMessage();
                Q_EMIT studyRequested(textOf(dataset), textOf(protocol));
            };
        });
}

void PhotographsPage::draw()
{
    FrictionPictureRequest request{.dataset = m_dataset, .conditions = chosenConditions(), .captions = {}};
    if (request.conditions.empty()) return;
    for (const QPushButton* condition : m_conditions)
        if (condition->isChecked()) request.captions << condition->text();
    request.theme = isDarkNow() ? Theme::DarkRoom : Theme::Light;
    request.widthPx = m_target->parentWidget()->width();
    request.fontPx = QFontInfo(QApplication::font()).pixelSize() * factorOf(Type::Plain);
    request.pixelRatio = devicePixelRatioF();
    run(*m_drawMessage, tr("The program renders the friction images. This can take minutes."),
        [this, request, draw = m_steps.draw](const ToolProgress& progress) -> InBackground::Then {
            return [this, request, picture = draw(request, progress)] {
                m_drawMessage->clearMessage();
                m_drawn = picture;
                showPicture();
                m_picture->setAccessibleName(tr("Friction images: %1").arg(request.captions.join(QStringLiteral(", "))));
                m_picture->show();
                m_study->setFocus();  // it stands below the picture, so the page scrolls to both
            };
        });
}

void PhotographsPage::showPicture()
{
    const int room = static_cast<int>(m_target->parentWidget()->width() * m_drawn.devicePixelRatio());
    if (!m_drawn.isNull())
        m_picture->setPixmap(
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
    m_targetMessage->clearMessage();
    m_checkMessage->clearMessage();
    m_drawMessage->clearMessage();
    m_studyMessage->clearMessage();
    m_warnings->hide();
    m_picture->hide();
    m_list->showWarnings({});
    proposeFolder();
    enable();
}

void PhotographsPage::proposeFolder()
{
    const auto* first = m_list->chosen();
    std::error_code unknown;
    const bool isTaken = fs::exists(pathIn(*m_target), unknown);
    if (!first || (m_isTargetTyped && !isTaken)) return;
    const fs::path beside = first->file.parent_path();
    fs::path free = beside.string() + "-fabrics";
    for (int number = 2; fs::exists(free, unknown); ++number) free = beside.string() + "-fabrics-" + std::to_string(number);
    m_target->setText(textOf(free));
}

void PhotographsPage::enable()
{
    const bool isFree = !m_work.isBusy(), hasPhotographs = !m_list->isEmpty(), isWritten = !m_dataset.empty();
    for (QWidget* part : std::initializer_list<QWidget*>{m_place, m_browseFiles, m_browseFolder, m_add, m_list, m_scale})
        part->setEnabled(isFree);
    for (QWidget* part : std::initializer_list<QWidget*>{m_check, m_target, m_browseTarget, m_write})
        part->setEnabled(isFree && hasPhotographs);
    for (QWidget* part : m_conditions) part->setEnabled(isFree && isWritten);
    for (QWidget* part : {m_draw, m_study}) part->setEnabled(isFree && isWritten);
    m_scale->setVisible(hasPhotographs);
    setButtonText(*m_back, isFree ? tr("Back (Esc)") : tr("Stop (Esc)"));
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
    else if (isEnter && focusWidget() == m_place)
        add(m_place->text());
    else if (isEnter && focusWidget() == m_target)
        write();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
