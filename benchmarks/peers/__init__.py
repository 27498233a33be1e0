"""Other programs, built and run on the same structures, against which edesign is verified and timed."""
