//! The file as it stands, every value with its place. Nothing here has a default: what the author
//! did not write is `None`, so that a curve can be laid over the file and the axis over a curve.

use super::drawing::{
    AutocorrelationTable, ImpulseLawTable, IndependenceTable, LayoutTable, OperatingPointTable,
    RegionTable,
};
use super::ride::RideTable;
use super::source::{ConfigError, Source};
use super::trace::TraceTable;
use super::value::{Critical, Number, Whole};
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};
use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use toml::Spanned;

/// A table of the file whose values are all optional.
macro_rules! section {
    ($(#[$doc:meta])* $name:ident { $($key:ident: $kind:ty),* $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Default, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(super) struct $name {
            $(pub $key: Option<Spanned<$kind>>),*
        }

        impl $name {
            /// This section where it says something, `base` where it does not.
            pub fn over(&self, base: &Self) -> Self {
                Self { $($key: self.$key.clone().or_else(|| base.$key.clone())),* }
            }

            /// Puts `value`, which stands at `span`, in the place of `key`.
            pub fn set(
                &mut self,
                key: &str,
                value: &toml::Value,
                span: Range<usize>,
            ) -> Result<(), toml::de::Error> {
                match key {
                    $(stringify!($key) => {
                        let value: $kind = value.clone().try_into()?;
                        self.$key = Some(Spanned::new(span, value));
                    })*
                    _ => unreachable!("no section has {key}"),
                }
                Ok(())
            }

            /// The keys that are written, each with the place of its value.
            pub fn written(&self) -> Vec<(&'static str, Range<usize>)> {
                let keys = [$((stringify!($key), self.span(stringify!($key)))),*];
                keys.into_iter().filter_map(|(key, span)| Some((key, span?))).collect()
            }

            /// Where the value of `key` stands.
            pub fn span(&self, key: &str) -> Option<Range<usize>> {
                match key {
                    $(stringify!($key) => self.$key.as_ref().map(Spanned::span),)*
                    _ => None,
                }
            }
        }
    };
}
pub(super) use section;

section! {
    /// `[sensor]`, exactly one of its keys.
    SensorSection { model: Model, ar: Vec<Number>, transfer: TransferTable }
}
section! {
    /// `[noise]`
    NoiseSection { law: LawKind, quantum: Number, range: Number }
}
section! {
    /// `[rest]`
    RestSection { drift: Number, swell: Number, footfalls: Number, jolt: Number }
}
section! {
    /// `[motion]`
    MotionSection {
        delta: Number, profile: ProfileKind, delta_at: DeltaAtKind, duration: Whole, offset: Whole,
    }
}
section! {
    /// `[impulses]`
    ImpulsesSection { nu: Number, theta: Number, during: DuringKind }
}
section! {
    /// `[whitening]`
    WhiteningSection { order: Whole, training: Whole, fit: FitKind, includes_reference: bool }
}
section! {
    /// `[samples]`
    SamplesSection {
        reference: Whole, shift: Whole, scale: Whole, gap: Whole, decimation: Whole,
    }
}
section! {
    /// `[detector]`
    DetectorSection {
        alpha: Number,
        rule: RuleKind,
        alternative: AlternativeKind,
        ties: TiesKind,
        calibrate: CalibrateKind,
    }
}

/// Hands the sections that a file has and a curve may change, each with its type, to another macro.
macro_rules! all_sections {
    ($callback:ident $($rest:tt)*) => {
        $callback! {
            {
                sensor: SensorSection,
                noise: NoiseSection,
                rest: RestSection,
                motion: MotionSection,
                impulses: ImpulsesSection,
                whitening: WhiteningSection,
                samples: SamplesSection,
                detector: DetectorSection,
            }
            $($rest)*
        }
    };
}

macro_rules! sections {
    ({ $($section:ident: $kind:ident,)* }) => {
        /// The sections that a file has and a curve may change.
        #[derive(Clone, Debug)]
        pub(super) struct Sections {
            $(pub $section: $kind,)*
        }

        impl Sections {
            /// Puts `value`, which stands at `span`, in the place of `key` in `section`.
            pub fn set(
                &mut self,
                (section, key): (&str, &str),
                value: &toml::Value,
                span: Range<usize>,
            ) -> Result<(), toml::de::Error> {
                match section {
                    $(stringify!($section) => self.$section.set(key, value, span),)*
                    _ => unreachable!("no section {section}"),
                }
            }

            /// Where the first of `keys` that the author wrote stands.
            pub fn first_span(&self, keys: &[(&str, &str)]) -> Option<Range<usize>> {
                keys.iter().find_map(|&(section, key)| match section {
                    $(stringify!($section) => self.$section.span(key),)*
                    _ => unreachable!("no section {section}"),
                })
            }

            /// These sections where they say something, `base` where they do not. A sensor is one
            /// choice: naming any replaces the other.
            pub fn over(&self, base: &Self) -> Self {
                let mut laid = Self { $($section: self.$section.over(&base.$section)),* };
                let SensorSection { model, ar, transfer } = &self.sensor;
                if model.is_some() || ar.is_some() || transfer.is_some() {
                    laid.sensor = self.sensor.clone();
                }
                laid
            }

            /// Every section and key that is written, with the place of its value.
            pub fn written(&self) -> Vec<(&'static str, &'static str, Range<usize>)> {
                let mut written = Vec::new();
                $(for (key, span) in self.$section.written() {
                    written.push((stringify!($section), key, span));
                })*
                written
            }
        }
    };
}

/// A struct with the sections beside its own keys. (`flatten` would lose the place of an error.)
macro_rules! with_sections {
    (
        { $($section:ident: $section_kind:ident,)* }
        $(#[$outer:meta])*
        $name:ident { $($(#[$attribute:meta])* $key:ident: $kind:ty),* $(,)? }
    ) => {
        $(#[$outer])*
        #[derive(Clone, Debug, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(super) struct $name {
            $($(#[$attribute])* pub $key: $kind,)*
            $(#[serde(default)] $section: $section_kind,)*
        }

        impl $name {
            pub fn sections(&self) -> Sections {
                Sections { $($section: self.$section.clone()),* }
            }
        }
    };
}

all_sections! { sections }

/// What the x axis sweeps, before it is known to be one thing.
pub(super) type AxisTable = Spanned<BTreeMap<Spanned<String>, Spanned<toml::Value>>>;

all_sections! { with_sections
    /// The whole file.
    File {
        question: String,
        seed: Whole,
        trials: Option<Spanned<Whole>>,
        half_width: Option<Spanned<Number>>,
        confidence: Option<Spanned<Number>>,
        common_random_numbers: Option<Spanned<bool>>,
        pilot: Option<Spanned<Whole>>,
        at_rest: Option<Spanned<bool>>,
        axis: Option<AxisTable>,
        autocorrelation: Option<Spanned<AutocorrelationTable>>,
        trace: Option<Spanned<TraceTable>>,
        layout: Option<Spanned<LayoutTable>>,
        region: Option<Spanned<RegionTable>>,
        independence: Option<Spanned<IndependenceTable>>,
        impulse_law: Option<Spanned<ImpulseLawTable>>,
        operating_point: Option<Spanned<OperatingPointTable>>,
        ride: Option<Spanned<RideTable>>,
        #[serde(default)]
        curve: Vec<CurveTable>,
        // What the report needs is read by itself.
        #[allow(dead_code, reason = "see `config::narrative`")]
        title: Option<IgnoredAny>,
        #[allow(dead_code, reason = "see `config::narrative`")]
        text: Option<IgnoredAny>,
        #[allow(dead_code, reason = "see `config::narrative`")]
        order: Option<IgnoredAny>,
        #[allow(dead_code, reason = "see `config::narrative`")]
        claim: Option<IgnoredAny>,
    }
}

all_sections! { with_sections
    /// `[[curve]]`
    #[derive(Default)]
    CurveTable {
        label: Option<Spanned<String>>,
        panel: Option<String>,
        series: Option<String>,
    }
}

impl File {
    /// Reads the text.
    pub fn parse(source: &Source) -> Result<Self, ConfigError> {
        source.read_all()
    }

    /// The curves, or the one that a file without any stands for.
    pub fn curves(&self) -> Vec<CurveTable> {
        match self.curve.is_empty() {
            true => vec![CurveTable::default()],
            false => self.curve.clone(),
        }
    }
}

/// `sensor.model`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Model {
    Adxl105,
}

/// `sensor.transfer`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TransferTable {
    pub a: Number,
    pub b: Number,
    pub c: Number,
    pub period: Number,
}

/// `noise.law`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum LawKind {
    Normal,
    Laplace,
    Logistic,
    Uniform,
    Cauchy,
    StudentT(Number),
    Contaminated { share: Number, scale: Number },
}

/// `motion.profile`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum ProfileKind {
    Rectangular,
    Trapezoid { rise: Number },
}

/// `motion.delta_at`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum DeltaAtKind {
    Record,
    Whitened,
}

/// `impulses.during`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum DuringKind {
    Motion,
    Inertial,
}

/// `whitening.fit`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum FitKind {
    LeastSquares,
    YuleWalker,
    Burg,
    Known,
    None,
}

/// `detector.rule`
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum RuleKind {
    Wilcoxon,
    Product,
    Disjunction,
    Conjunction,
    Table(Vec<Critical>),
    LikelihoodRatio,
    StudentT,
    VarianceRatio,
    BlockMeans,
    Clairvoyant,
}

/// `detector.ties`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum TiesKind {
    Random,
    ByPosition,
    Strict,
}

/// `detector.calibrate`: yes, no, or the noise to calibrate on.
#[derive(Clone, Debug)]
pub(super) enum CalibrateKind {
    Promise(bool),
    Measured(MeasuredTable),
}

/// The noise to calibrate on, where it is not the point's own.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeasuredTable {
    pub law: Option<LawKind>,
    pub sensor: Option<SensorSection>,
}

impl<'de> Deserialize<'de> for CalibrateKind {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CalibrateVisitor)
    }
}

struct CalibrateVisitor;

impl<'de> Visitor<'de> for CalibrateVisitor {
    type Value = CalibrateKind;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("true, false or a table such as { law = \"normal\" }")
    }

    fn visit_bool<E>(self, value: bool) -> Result<CalibrateKind, E> {
        Ok(CalibrateKind::Promise(value))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<CalibrateKind, A::Error> {
        let table = MeasuredTable::deserialize(MapAccessDeserializer::new(map))?;
        Ok(CalibrateKind::Measured(table))
    }
}

/// `detector.alternative`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum AlternativeKind {
    Greater,
    Less,
    TwoSided,
}
