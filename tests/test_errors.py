"""All errors of the package are one class, have a text, and go through a pickle, as of a process."""

import pickle

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.base.errors import InvalidArgument, InvalidEntries
from mdr_core.base.remark import MeasurementError, Remark
from mdr_core.solver.impacts.motion_solver import ConvergenceError

DEPTH = np.linspace(0, 1e-7, 50)


def unknown_columns():
    from mdr_core.measurements.files.several import curves_of_text

    options = {"columns": None, "by": None, "given": {}}
    curves_of_text("Tiefe (nm),Kraft (mN)\n0,0\n1,1\n2,4\n", "run.csv", options)


RAISE = {
    InvalidArgument: lambda: mdr.Medium("soft"),
    InvalidEntries: lambda: mdr.Cone([0.3, -0.3]),
    MeasurementError: lambda: mdr.fit_indentation(mdr.Cone(0.3), DEPTH, DEPTH, eta=None),
    mdr.UnknownColumns: unknown_columns,
    mdr.MDRError: lambda: mdr.Structure.modal([1.0], [[1.0]]),
}


def said(error):
    return type(error), str(error), error.text, error.kind, error.remedy


@pytest.mark.parametrize("kind", RAISE)
def test_an_error_is_raised_with_its_text_and_stays_one_through_a_pickle(kind):
    with pytest.raises(mdr.MDRError) as raised:
        RAISE[kind]()
    error = raised.value
    assert type(error) is kind
    assert isinstance(error, ValueError)
    assert error.text
    assert said(pickle.loads(pickle.dumps(error))) == said(error)


def test_the_error_of_a_search_names_its_rows_through_a_pickle():
    error = pickle.loads(pickle.dumps(ConvergenceError(np.array([2]))))
    assert isinstance(error, mdr.MDRError)
    assert error.rows.tolist() == [2]


def test_the_error_of_a_measurement_has_the_kind_of_its_remark():
    error = MeasurementError(Remark("there is none", "no unloading", mdr.Remedy("part", "all")))
    assert (error.kind, error.text) == ("no unloading", "there is none")
    assert str(error) == "there is none; give the whole record"
