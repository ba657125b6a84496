"""What watches over experiment.launch."""
