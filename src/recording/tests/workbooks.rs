//! Sheets of workbooks.

use super::*;

const BOOK: &str = r#"<?xml version="1.0"?><workbook xmlns:r="r"><sheets>
    <sheet name="Chart" r:id="c"/><sheet name="Lift &amp; rope" sheetId="1" r:id="a"/>
    <sheet name="Notes" sheetId="2" r:id="b"/></sheets></workbook>"#;
const RELATIONS: &str = r#"<Relationships>
    <Relationship Id="c" Type="http://x/chartsheet" Target="chartsheets/sheet1.xml"/>
    <Relationship Id="a" Type="http://x/worksheet" Target="worksheets/one.xml"/>
    <Relationship Id="b" Type="http://x/worksheet" Target="/xl/worksheets/two.xml"/></Relationships>"#;
const SHARED: &str = r#"<sst><si><t>Time (s)</t></si><si><r><t>Acceleration</t></r><r><t xml:space="preserve"> z</t></r>
    <rPh sb="0" eb="1"><t>hint</t></rPh><t> (m/s</t><t>&#178;)</t></si></sst>"#;
const STYLES: &str = r#"<styleSheet><numFmts><numFmt numFmtId="164" formatCode="&quot;at &quot;hh:mm:ss.000"/>
    <numFmt numFmtId="165" formatCode="[Red]0.00&quot; steps&quot;"/></numFmts>
    <cellStyleXfs><xf numFmtId="22"/></cellStyleXfs>
    <cellXfs><xf numFmtId="0"/><xf numFmtId="164"/><xf numFmtId="165"/></cellXfs></styleSheet>"#;
/// A blank cell between, text in the cell, a formula, a column without a place, calculations beside.
const SHEET: &str = r#"<x:worksheet xmlns:x="x"><x:sheetData>
    <x:row r="2"><x:c r="A2" t="s"><x:v>0</x:v></x:c><x:c r="C2" t="s"><x:v>1</x:v></x:c>
        <x:c r="D2" t="inlineStr"><x:is><x:t>good &lt;?</x:t></x:is></x:c></x:row>
    <x:row r="3"><x:c r="A3" s="2"><x:v>1E-2</x:v></x:c><x:c r="C3"><x:f>-0.15+0</x:f><x:v>-0.15</x:v></x:c>
        <x:c r="D3" t="b"><x:v>1</x:v></x:c><x:c r="F3"><x:v>99</x:v></x:c></x:row>
    <x:row><x:c><x:v>0.02</x:v></x:c><x:c t="e"><x:v>#DIV/0!</x:v></x:c><x:c><x:v>0.25</x:v></x:c></x:row>
    <x:row r="6"><x:c r="A6"><x:v>0.03</x:v></x:c><x:c r="C6" t="str"><x:v>0.5</x:v></x:c><x:c r="D6" t="s"/></x:row>
    </x:sheetData></x:worksheet>"#;

/// A workbook whose part `name` is `text`.
fn with(name: &str, text: &str) -> Vec<u8> {
    let parts = [
        ("xl/workbook.xml", BOOK),
        ("xl/_rels/workbook.xml.rels", RELATIONS),
        ("xl/sharedStrings.xml", SHARED),
        ("xl/styles.xml", STYLES),
        ("xl/worksheets/one.xml", SHEET),
        ("xl/worksheets/two.xml", "<worksheet/>"),
    ];
    archive(&parts.map(|(part, own)| (part, if part == name { text } else { own })))
}

fn open_sheet(bytes: Vec<u8>, member: Option<&str>) -> Result<Recording, RecordingError> {
    let member = member.map(str::to_owned);
    let reading = Reading {
        member,
        ..Reading::default()
    };
    Recording::from_bytes("ride.xlsx", bytes, &reading)
}

/// What is said of a workbook with this sheet.
fn refused_sheet(text: &str) -> String {
    refused_part("xl/worksheets/one.xml", text)
}

fn refused_part(name: &str, text: &str) -> String {
    open_sheet(with(name, text), None).unwrap_err().to_string()
}

#[test]
fn cells_stand_in_their_columns() {
    let recording = open_sheet(with("", ""), None).unwrap();
    let expected = [(0.01, -0.15), (0.02, 0.25), (0.03, 0.5)];
    assert_eq!(read(&recording), expected);
    assert_eq!(recording.format(), "phyphox");
    assert_eq!(recording.member(), Some("Lift & rope"));
    let names = recording.acceleration_columns();
    assert_eq!(names, ["Acceleration z (m/s²)"]);
    assert_eq!(recording.warnings(), []);
}

#[test]
fn dates_are_days() {
    let rows = (0..4).map(|i| {
        let days = 45_000.5 + f64::from(i) / 864_000.0;
        format!(
            "<row><c s=\"1\"><v>{days}</v></c><c><v>{}</v></c></row>",
            i % 2
        )
    });
    let sheet = format!(
        "<worksheet><sheetData>{}</sheetData></worksheet>",
        rows.collect::<String>()
    );
    let recording = open_sheet(with("xl/worksheets/one.xml", &sheet), None);
    let facts = recording.unwrap().facts().clone();
    assert_eq!(facts.rate.round(), 10.0);
    let zero = facts.clock_zero.unwrap().to_string();
    assert_eq!(zero, "2023-03-15T12:00:00.000");
}

#[test]
fn a_sheet_is_named() {
    let error = open_sheet(with("", ""), Some("Lift"))
        .unwrap_err()
        .to_string();
    assert!(error.contains("no sheet \"Lift\""), "{error}");
    assert!(
        error.contains("(there are \"Lift & rope\", \"Notes\")"),
        "{error}"
    );
    let error = open_sheet(with("", ""), Some("Notes"))
        .unwrap_err()
        .to_string();
    assert!(error.starts_with("ride.xlsx:Notes: is empty"), "{error}");
}

#[test]
fn damage_is_refused() {
    let row = |cell: &str| format!("<sheetData><row>{cell}</row></sheetData>");
    let deep = "<a>".repeat(1000) + &"</a>".repeat(1000);
    let wide = format!("<a b=\"{}\"/>", "x".repeat(1 << 20));
    let texts = format!("<sst>{}</sst>", "<si/>".repeat((1 << 20) + 1));
    for (text, expected) in [
        (&SHEET[..SHEET.len() / 2], "syntax error: tag not closed"),
        ("<sheetData>", "ends within an element"),
        ("<row></sheetData>", "ill-formed document"),
        ("\u{fffe}<", "syntax error"),
        (&row("<c t=\"s\"><v>2</v></c>"), "there is no shared text 2"),
        (&row("<c t=\"s\"><v>-</v></c>"), "there is no shared text -"),
        (
            &row("<c r=\"B1\"/><c r=\"A1\"/>"),
            "the cells of row 1 must stand in order",
        ),
        ("<row r=\"0\"/>", "row 0 must stand after row 0"),
        ("<row r=\"x\"/>", "r=\"x\" is no number"),
        ("<row r=\"1048577\"/>", "at most 1048576 rows"),
        ("<row r=3/>", "attribute"),
        (&row("<c><v>&bomb;</v></c>"), "has an unknown entity &bomb;"),
        (&deep, "is nested more than 64 deep"),
        (&wide, "is too large"),
    ] {
        let error = refused_sheet(text);
        assert!(error.contains(expected), "{error}");
        let place = "ride.xlsx: workbook: xl/worksheets/one.xml: ";
        assert!(
            error.starts_with(place) && error.ends_with("(export as CSV)"),
            "{error}"
        );
    }
    let error = refused_part("xl/sharedStrings.xml", &texts);
    assert!(
        error.contains("xl/sharedStrings.xml: must have at most 1048576 rows and texts"),
        "{error}"
    );
    let error = refused_part("xl/workbook.xml", "<workbook/>");
    assert!(error.contains("no sheet \"\" (there are none)"), "{error}");
}

#[test]
fn parts_must_be_there() {
    let parts = [
        ("xl/workbook.xml", BOOK),
        ("xl/_rels/workbook.xml.rels", RELATIONS),
    ];
    for (number, missing) in [
        (1, "xl/_rels/workbook.xml.rels"),
        (2, "xl/worksheets/one.xml"),
    ] {
        let error = open_sheet(archive(&parts[..number]), None)
            .unwrap_err()
            .to_string();
        assert!(
            error.contains(&format!("there is no part {missing}")),
            "{error}"
        );
    }
    // Neither shared texts nor styles need be there.
    let sheet =
        "<row><c><v>0</v></c><c><v>1</v></c></row><row><c><v>0.1</v></c><c><v>2</v></c></row>";
    let sheet = format!("<worksheet>{sheet}</worksheet>");
    let parts = [parts[0], parts[1], ("xl/worksheets/one.xml", &*sheet)];
    assert_eq!(
        read(&open_sheet(archive(&parts), None).unwrap()),
        [(0.0, 1.0), (0.1, 2.0)]
    );
}
