#include "study/app/pages/photographs/photograph_form.h"

#include <QHBoxLayout>
#include <QPlainTextEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <QShortcut>
#include <QVBoxLayout>

#include "study/app/pages/photographs/photograph_list.h"
#include "study/app/pages/photographs/photograph_scale.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

/// Conditions that need photographs only.
struct OfferedCondition {
    const char* id;
    const char* name;
    bool isChosen;
};
constexpr OfferedCondition offeredConditions[] = {
    {"v_grey", QT_TRANSLATE_NOOP("study::app::PhotographForm", "Grey photograph"), false},
    {"v_shape", QT_TRANSLATE_NOOP("study::app::PhotographForm", "Shape from shading"), false},
    {"h_g", QT_TRANSLATE_NOOP("study::app::PhotographForm", "Generated height"), false},
    {"f_g", QT_TRANSLATE_NOOP("study::app::PhotographForm", "Generated friction"), false},
    {"h_g&f_g", QT_TRANSLATE_NOOP("study::app::PhotographForm", "Generated height and friction"), true}};

}  // namespace

PhotographForm::PhotographForm(QWidget& page)
    : place(field("photographsField", tr("Photograph or folder"), &page)),
      browseFiles(button("browsePhotographsButton", tr("Browse files…"), &page)),
      browseFolder(button("browsePhotographFolderButton", tr("Browse folders…"), &page)),
      add(mainButton("addPhotographsButton", tr("Add (Enter)"), &page)),
      placeMessage(new MessageBar("photographsMessage", &page)),
      list(new PhotographList(&page)),
      scale(new PhotographScale(&page)),
      check(button("checkPhotographsButton", tr("Check the photographs"), &page)),
      checkMessage(new MessageBar("photographCheckMessage", &page)),
      warnings(new QPlainTextEdit(&page)),
      target(field("newDatasetField", tr("Folder of the new data set"), &page)),
      browseTarget(button("browseNewDatasetButton", tr("Browse…"), &page)),
      write(mainButton("writeDatasetButton", tr("Write the data set"), &page)),
      targetMessage(new MessageBar("newDatasetMessage", &page)),
      draw(button("drawFrictionImagesButton", tr("Render"), &page)),
      drawMessage(new MessageBar("frictionImagesMessage", &page)),
      picture(new QLabel(&page)),
      toStudy(mainButton("photographsToStudyButton", tr("Go on to the new study"), &page)),
      studyMessage(new MessageBar("photographsStudyMessage", &page)),
      back(button("photographsBackButton", tr("Back (Esc)"), &page))
{
    for (int number = 1; const OfferedCondition& offered : offeredConditions) {
        conditions.push_back(button(qPrintable(QStringLiteral("conditionButton%1").arg(number++)), tr(offered.name), &page));
        conditions.back()->setCheckable(true);
        conditions.back()->setChecked(offered.isChosen);
    }
    build(page);
}

std::vector<std::string> PhotographForm::chosenConditions() const
{
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < conditions.size(); ++i)
        if (conditions[i]->isChecked()) ids.emplace_back(offeredConditions[i].id);
    return ids;
}

void PhotographForm::addStep(QVBoxLayout& column, const char* objectName, const QString& title, const QString& sentence)
{
    column.addSpacing(20);
    auto* head = label(objectName, Type::Lead, column.parentWidget(), Weight::Bold);
    head->setText(title);
    column.addWidget(head);
    auto* text =
        quietLabel(qPrintable(QLatin1String(objectName) + QLatin1String("Sentence")), column.parentWidget(), Type::Plain);
    text->setText(sentence);
    column.addWidget(text);
}

void PhotographForm::build(QWidget& page)
{
    auto* sheet = new QWidget(&page);
    auto* title = label("photographsTitle", Type::Title, sheet, Weight::Bold);
    title->setText(tr("Data set from photographs"));
    auto* column = new QVBoxLayout(sheet);
    column->setSpacing(8);
    column->addWidget(title);
    buildPhotographs(*column);
    buildResults(*column);
    column->addLayout(actionsRow({toStudy}));
    column->addWidget(studyMessage);
    column->addStretch(1);
    column->addWidget(appearanceHint(sheet));
    auto* outer = new QVBoxLayout(&page);
    outer->setContentsMargins(0, 0, 0, 0);
    auto* area = scrolling("photographsArea", sheet, &page);
    sheet->setProperty("scrollsAlways", true);  // page_fit.h
    outer->setSpacing(0);
    outer->addWidget(area, 1);
    // Outside the area, so that long work can be stopped from every place of the page.
    auto* bar = new QFrame(&page);
    bar->setObjectName("photographsBar");
    setRole(*bar, "bar");
    auto* barRow = new QHBoxLayout(bar);
    barRow->setContentsMargins(28, 8, 28, 8);
    barRow->addWidget(back);
    barRow->addStretch(1);
    outer->addWidget(bar);
    for (const auto& [key, step] : {std::pair(Qt::Key_Up, -1), std::pair(Qt::Key_Down, +1)}) {
        auto* shortcut = new QShortcut(QKeySequence(Qt::CTRL | key), &page);
        shortcut->setContext(Qt::WidgetWithChildrenShortcut);
        QObject::connect(shortcut, &QShortcut::activated, &page, [bar = area->verticalScrollBar(), step = step] {
            bar->setValue(bar->value() + step * bar->pageStep() / 3);
        });
    }
    orderTabs();
}

void PhotographForm::orderTabs() const
{
    QWidget::setTabOrder(place, browseFiles);
    QWidget::setTabOrder(browseFiles, browseFolder);
    QWidget::setTabOrder(browseFolder, add);
    QWidget::setTabOrder(add, list->findChild<QWidget*>("byFileButton"));
    setTabOrderAfter(*list, {scale->findChild<QWidget*>("pixelWidthField")});
    setTabOrderAfter(*scale, {check, warnings, target, browseTarget, write, conditions.front()});
    for (std::size_t i = 1; i < conditions.size(); ++i) QWidget::setTabOrder(conditions[i - 1], conditions[i]);
    QWidget::setTabOrder(conditions.back(), draw);
    QWidget::setTabOrder(draw, toStudy);
    QWidget::setTabOrder(toStudy, back);
}

void PhotographForm::buildPhotographs(QVBoxLayout& column)
{
    addStep(column, "stepPhotographs", tr("1  Photographs"),
            tr("Take all pictures with one camera, from straight above, at the same distance. Lay a ruler into one of them."));
    place->setPlaceholderText(tr("an image file, or a folder with images"));
    auto* row = new QHBoxLayout;
    row->setSpacing(10);
    row->addWidget(place, 1);
    column.addLayout(row);
    column.addWidget(placeMessage);
    column.addLayout(actionsRow({add, browseFiles, browseFolder}));
    column.addWidget(list);
    addStep(column, "stepScale", tr("2  Scale"),
            tr("One scale holds for all photographs. Give one of the three lengths, or leave them if you do not know it."));
    column.addWidget(scale);
}

void PhotographForm::buildResults(QVBoxLayout& column)
{
    name(*warnings, "photographWarnings", tr("Warnings about the photographs"));
    setType(*warnings, Type::Plain);
    warnings->setReadOnly(true);
    warnings->setTabChangesFocus(true);
    warnings->hide();
    picture->setObjectName("frictionImages");
    picture->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    picture->setMinimumWidth(1);  // the picture follows the page, not the page the picture
    picture->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    picture->hide();
    addStep(column, "stepCheck", tr("3  Check"),
            tr("Does each photograph resemble those that the networks learned from? Otherwise height and friction are guesses."));
    column.addLayout(actionsRow({check}));
    column.addWidget(checkMessage);
    column.addWidget(warnings);
    addStep(column, "stepDataset", tr("4  Data set"), tr("The program makes this folder. Nothing that exists is overwritten."));
    auto* row = new QHBoxLayout;
    row->setSpacing(10);
    row->addWidget(target, 1);
    row->addWidget(browseTarget);
    target->setPlaceholderText(tr("a folder that does not exist yet"));
    column.addLayout(row);
    column.addWidget(targetMessage);
    column.addLayout(actionsRow({write}));
    addStep(
        column, "stepImages", tr("5  Conditions and friction images"),
        tr("Choose the conditions. If you wish, look at the images that participants will feel: bright means high friction."));
    auto* conditionsRow = new FlowLayout(10, 8);
    for (QPushButton* condition : conditions) conditionsRow->addWidget(condition);
    column.addLayout(conditionsRow);
    column.addLayout(actionsRow({draw}));
    column.addWidget(drawMessage);
    column.addWidget(picture);
    addStep(
        column, "stepStudy", tr("6  Study"),
        tr("The program writes a protocol beside the data set: the questions of the paper under the chosen conditions. You may "
           "edit it."));
}

}  // namespace study::app
