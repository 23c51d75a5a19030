// A double click on a plot shows the whole of it.
cb_obj.origin.reset.emit();
