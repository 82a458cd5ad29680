-- What a range sensor saw with a picture of a tour: the contract's "sweep" as CBOR.
CREATE TABLE tour_sweeps (
  tour TEXT NOT NULL,
  number INTEGER NOT NULL,
  sweep BLOB NOT NULL,
  PRIMARY KEY (tour, number),
  FOREIGN KEY (tour, number) REFERENCES tour_images (tour, number) ON DELETE CASCADE
) STRICT;
